# Completes the words of howl in fish: howl help completion fish | source
function __howl_complete
    set -l words (commandline -opc)
    set -l typed (commandline -ct)
    set -l program $words[1]
    set -e words[1]
    # fish replaces the whole word: --name=value, not the value alone.
    set -l prefix (string match -r -- '^--[^=]*=' $typed)
    set -l value (string replace -r -- '^--[^=]*=' '' $typed)
    for line in ($program help complete $words "$typed" 2>/dev/null)
        switch $line
            case ':folders'
                string replace -r -- '^' "$prefix" (__fish_complete_directories "$value")
            case ':files'
                string replace -r -- '^' "$prefix" (__fish_complete_path "$value")
            case ':configs'
                string replace -r -- '^' "$prefix" \
                    (__fish_complete_path "$value" | string match -r -- '^.*(?:/|\.ya?ml)(?:\t.*)?$')
            case '*'
                echo -- "$prefix$line"
        end
    end
end
complete -c howl -f -a '(__howl_complete)'

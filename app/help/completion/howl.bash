# Completes the words of howl in bash: source <(howl help completion bash)
_howl() {
  local rest=${COMP_LINE:0:COMP_POINT} words=() token gap typed prefix line
  # Bash breaks words at = and : too; what no blank parts is one word to howl.
  for token in "${COMP_WORDS[@]:0:COMP_CWORD+1}"; do
    gap=${rest%%[![:space:]]*}
    rest=${rest:${#gap}}
    token=${rest:0:${#token}}
    rest=${rest:${#token}}
    if [[ -n $gap || ${#words[@]} -eq 0 ]]; then words+=("$token"); else words[-1]+=$token; fi
  done
  typed=${words[-1]}
  [[ $typed == -*=* ]] && typed=${typed#*=}
  # Bash replaces what follows its last break alone.
  prefix=${typed%"${typed##*[=:]}"}
  COMPREPLY=()
  while IFS= read -r line; do
    case $line in
      :folders)
        compopt -o filenames
        mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -d -- "$typed")
        ;;
      :files | :configs)
        compopt -o filenames
        while IFS= read -r token; do
          if [[ $line == :files || -d $token || $token == *.yaml || $token == *.yml ]]; then
            COMPREPLY+=("$token")
          fi
        done < <(compgen -f -- "$typed")
        ;;
      *)
        line=${line%%$'\t'*}
        COMPREPLY+=("${line#"$prefix"}")
        ;;
    esac
  done < <("${words[0]/#\~\//$HOME/}" help complete "${words[@]:1}" 2>/dev/null)
}
complete -F _howl howl

#compdef howl
# Completes the words of howl in zsh: source <(howl help completion zsh), after compinit
_howl() {
  local -a lines found
  local line files name
  lines=("${(@f)$("${(Q)words[1]/#\~\//$HOME/}" help complete \
    "${(@Q)words[2,CURRENT-1]}" "${(Q)PREFIX}" 2>/dev/null)}")
  for line in $lines; do
    if [[ $line == :* ]]; then
      files=$line
    else
      name=${line%%$'\t'*}
      found+=("${name//:/\\:}:${line#*$'\t'}")
    fi
  done
  compset -P '--*='
  (($#found)) && _describe 'howl' found
  case $files in
    :folders) _files -/ ;;
    :configs) _files -g '*.(yaml|yml)' ;;
    :files) _files ;;
  esac
}
if [[ ${funcstack[1]} == _howl ]]; then
  _howl "$@"
else
  compdef _howl howl
fi

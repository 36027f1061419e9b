# completes `urdfsync` in bash: eval "$(urdfsync completion bash)"
_urdfsync() {
  local IFS=$' \t\n' line=${COMP_LINE:0:COMP_POINT} words
  read -a words <<<"$line"
  [[ $line == *[[:blank:]] ]] && words+=("")
  local IFS=$'\n' word=${line##*[[:blank:]]}
  COMPREPLY=($(urdfsync completion bash -- "${words[@]:1}" 2>/dev/null))
  COMPREPLY=("${COMPREPLY[@]%%$'\t'*}")
  case "${COMPREPLY[0]}" in
    :files) COMPREPLY=(); compopt -o default 2>/dev/null ;;
    *[=.]) compopt -o nospace 2>/dev/null ;;
  esac
  COMPREPLY=("${COMPREPLY[@]#"${word%"${word##*=}"}"}") # for bash, a word begins after `=`
}
complete -F _urdfsync urdfsync

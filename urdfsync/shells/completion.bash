# completes `urdfsync` in bash: eval "$(urdfsync completion bash)"
_urdfsync() {
  local IFS=$'\n'
  COMPREPLY=($(urdfsync completion bash -- "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null))
  case "${COMPREPLY[0]}" in
    :files) COMPREPLY=(); compopt -o default 2>/dev/null ;;
    */*) compopt -o filenames 2>/dev/null ;;
    *[=.]) compopt -o nospace 2>/dev/null ;;
  esac
}
complete -F _urdfsync urdfsync

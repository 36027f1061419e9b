#compdef urdfsync
# completes `urdfsync` in zsh: eval "$(urdfsync completion zsh)", below compinit
_urdfsync() {
  local -a lines whole open whole_shown open_shown
  local line
  lines=("${(@f)$(urdfsync completion zsh -- "${(@Q)words[2,CURRENT]}" 2>/dev/null)}")
  if [[ $lines[1] == :files ]]; then
    [[ $PREFIX == --*=* ]] && compset -P '*='
    _files
    return
  fi
  for line in $lines; do
    if [[ ${line%%$'\t'*} == *[=.] ]]; then
      open+=("${line%%$'\t'*}") open_shown+=("${line/$'\t'/  }")
    elif [[ -n $line ]]; then
      whole+=("${line%%$'\t'*}") whole_shown+=("${line/$'\t'/  }")
    fi
  done
  compadd -l -d whole_shown -a whole
  compadd -S '' -l -d open_shown -a open
}
if [[ $funcstack[1] == _urdfsync ]]; then _urdfsync "$@"; else compdef _urdfsync urdfsync; fi

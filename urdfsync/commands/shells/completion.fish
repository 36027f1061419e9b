# completes `urdfsync` in fish: urdfsync completion fish | source
function __urdfsync_complete
    set -l words (commandline -opc)
    set -l current (commandline -ct)
    set -l lines (urdfsync completion fish -- $words[2..-1] "$current" 2>/dev/null)
    if test "$lines[1]" = :files
        set -l begin (string match -r -- '^--[^=]*=' "$current")
        set -l path (string replace -r -- '^--[^=]*=' '' "$current" | string unescape)
        for each in (__fish_complete_path "$path")
            printf '%s\n' "$begin$each"
        end
    else
        printf '%s\n' $lines
    end
end
complete -c urdfsync -f -a '(__urdfsync_complete)'

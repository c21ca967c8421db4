# SPDX-License-Identifier: GPL-3.0-only
# shellcheck shell=bash
# Completion of sprag in bash: options, scenes, and after --set and --help the names of parameters, as the program tells them.

_sprag()
{
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} section='' program line name end
  COMPREPLY=()
  if [ "$before" = --set ] || { [[ $before == @(-h|--help) ]] && [[ $word != -* ]]; }; then
    [ "$before" != --set ] || { end='=' && compopt -o nospace 2>/dev/null; }
    while read -r line; do
      case $line in
        'subsection '*) section=${line#subsection } ;;
        'set '* | '#set '*)
          name=${line#*set }
          name=${name%%=*}
          name=$section/${name%"${name##*[![:space:]]}"}
          [[ $name != "${word//\\/}"* ]] || COMPREPLY+=("$(printf %q "$name")$end")
          ;;
      esac
    done < <("$1" --print-parameters 2>/dev/null)
  elif [ "$before" = --from ]; then
    program=$(dirname "$(readlink -f "$(command -v "$1")")")
    mapfile -t COMPREPLY < <(compgen -W "$(cd "$program" && ls {..,../../share/sprag}/params 2>/dev/null | sed -n 's/\.prm$//p')" -- "$word")
  elif [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$("$1" --help 2>/dev/null | grep -o -- '--[a-z][a-z-]*')" -- "$word" | sort -u)
  else
    mapfile -t COMPREPLY < <(compgen -f -X '!*.prm' -- "$word"; compgen -d -S / -- "$word")
  fi
}
complete -o filenames -F _sprag sprag

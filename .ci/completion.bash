# SPDX-License-Identifier: GPL-3.0-only
# shellcheck shell=bash
# Completion of sprag in bash: options, scenes, and after --set the names of parameters, all as the program itself tells them.

_sprag()
{
  local word=${COMP_WORDS[COMP_CWORD]} section='' line name
  COMPREPLY=()
  if [ "${COMP_WORDS[COMP_CWORD - 1]}" = --set ]; then
    while read -r line; do
      case $line in
        'subsection '*) section=${line#subsection } ;;
        'set '* | '#set '*)
          name=${line#*set }
          name=${name%%=*}
          name=$section/${name%"${name##*[![:space:]]}"}
          [[ $name != "${word//\\/}"* ]] || COMPREPLY+=("$(printf %q "$name")=")
          ;;
      esac
    done < <("$1" --print-parameters 2>/dev/null)
    compopt -o nospace 2>/dev/null
  elif [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$("$1" --help 2>/dev/null | grep -o -- '--[a-z][a-z-]*')" -- "$word" | sort -u)
  else
    mapfile -t COMPREPLY < <(compgen -f -X '!*.prm' -- "$word"; compgen -d -S / -- "$word")
  fi
}
complete -o filenames -F _sprag sprag

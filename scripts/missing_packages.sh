#!/usr/bin/env bash
# missing_packages.sh LOG: names what a failed build asked for in vain (a header, a library, a CMake package, a program), and
# the Debian package that holds it where this machine knows. Prints nothing when the log complains of something else.
set -u
log=$1

# CMake wraps its messages.
joined=$(tr '\n' ' ' <"$log" | sed 's/  */ /g')

# found REGEX: what it matches, in the log's lines or in CMake's messages.
found() { { grep -oP "$1" "$log"; grep -oP "$1" <<<"$joined"; } | tr -d ',' | sort -u; }

# A line per missing thing: its name, and the files that would be it, as patterns of dpkg -S.
wanted() {
    found 'fatal error: \K[^ ]+(?=: No such file)' | sed 's|.*|& */include/& */include/*/&|'
    found "'\K/[^']+(?=', needed by)" | sed 's|.*|& &|'
    found 'references the file "\K/[^"]+' | sed 's|.*|& &|'
    found 'cannot find -l\K[^ :]+' | sed 's|.*|lib& */lib&.so */lib&.a|'
    found '(package configuration file provided by "|Could NOT find )\K\w+' |
        sed 's|.*|CMake:& */&Config.cmake */\L&-config.cmake|'
    found 'using the following names: \K[^ ]+' | sed 's|.*|& */lib&.so */lib&.a */bin/&|'
    found 'using the following files: \K[^ ]+' | sed 's|.*|& */include/& */include/*/&|'
    found '[^ :]+(?=: command not found)' | sed 's|.*|& */bin/& */sbin/&|'
}

wanted | sort -u | while read -r name patterns; do
    set -f
    packages=$(dpkg -S $patterns 2>/dev/null | grep -v '^diversion' | cut -d: -f1 | sort -u | head -n 3 | paste -sd' ')
    set +f
    echo "missing: $name${packages:+, in the package $packages}"
done

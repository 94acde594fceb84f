#!/usr/bin/env bash
# Fails where the code, its comments or the documents use a word that was given up for the field's own. The first column is
# what is looked for (a Perl regular expression), the second what to say instead; docs/design.md, "Words", has the reasons.
set -euo pipefail
cd "$(dirname "$0")/.."
words=(
    '\bleftovers?\b'                                             'remainder, remaining motion'
    '\bmost_[a-z]+\b(?<!most_recent)'                            'max_...'
    '\b(a|the|its|this|of|by) share\b|\bshares? of\b'            'fraction'
    '\b(told|tells)\b'                                           'described, reported, explained'
    '\bwhoever\b|\bhe who\b|\bfor who\b|\b(carry|push|hold)s? who\b'  'a player that'
    '\b(row|line|byte|bytes|triangle|metre|tick) a (tick|face|triangle|cell|second|record|row)\b'  'per'
    '\bhollow (surface|edge)s?\b'                                'concave'
    '\bsweeps? (meets?|met)\b'                                   'hits'
    '\bM_PI\b'                                                   'std::numbers::pi, which Windows has, too'
)
bad=0
for ((i = 0; i < ${#words[@]}; i += 2)); do
    if found=$(git grep -nIiP "${words[i]}" -- '*.h' '*.cpp' '*.inc' '*.md' '*.sh' ':!scripts/check_words.sh'); then
        printf '%s\n    say: %s\n' "$found" "${words[i + 1]}"
        bad=1
    fi
done
exit $bad

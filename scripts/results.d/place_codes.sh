# Places by visual words: bags of binary words and of SIFT, LLC, LLC of landmarks, beside all cues.
title="Places by visual words"
[ -d "$data/places" ] || { absent "$title"; return 0; }
heading "$title"
command_line "placegraph train vocabulary OTHER SETS --out words.pgw --kind binary --words 10000 --descriptors 60000    # bow"
command_line "placegraph train vocabulary OTHER SETS --out words.pgw --kind float --words 10000 --descriptors 60000     # the others"
command_line "placegraph match SET --codes CODES --vocabulary words.pgw --out found.txt"
. scripts/results.d/place_sets.sh
vocabularies=$out/place-vocabularies
mkdir -p "$vocabularies"
# learned SET NAME ARGUMENTS...: a vocabulary of all sets but this one
learned() {
  left_out=$1; name=$2; shift 2
  others=
  for other in $sets vtm_virtual_house; do
    [ "$other" = "$left_out" ] || others="$others $(folder_of "$other")"
  done
  say "learning words for $left_out: $name"
  # shellcheck disable=SC2086
  $placegraph train vocabulary $others --out "$vocabularies/$name-$left_out.pgw" --descriptors 60000 --force "$@" > "$out/vocabulary.log" 2>&1
}
for s in $sets vtm_virtual_house; do
  learned "$s" binary --kind binary --words 10000
  learned "$s" float --kind float --words 10000
done
prose << 'NOTE'
Every vocabulary is learned from the three sets other than the one that it is judged on; `bow, own words` learns its words
from the images that it has seen. A cell is R@1 / AP / recall at full precision of single images; of vtm_virtual_house it
is the share of images whose most similar training image is of their place. CPU is the whole time of one image.
NOTE
columns codes $sets vtm_virtual_house "CPU, kitchen [ms]"
for codes in cues "bow online" bow bow_float llc landmarks; do
  set --
  for s in $sets vtm_virtual_house; do
    case $codes in
      cues | "bow online") words= ;;
      bow) words="--vocabulary $vocabularies/binary-$s.pgw" ;;
      *) words="--vocabulary $vocabularies/float-$s.pgw" ;;
    esac
    # shellcheck disable=SC2086
    found place-codes "$s" --codes "${codes% online}" $words
    [ "$s" != kitchen ] || cost=$(sed -n 's/.* \([0-9.]*\) ms CPU.*/\1/p' "$out/place-codes.log")
    set -- "$@" "$(figures place-codes "$s")"
  done
  case $codes in
    cues) name="all cues" ;;
    "bow online") name="bow, own words" ;;
    *) name=$codes ;;
  esac
  cells "$name" "$@" "${cost:-}"
done

prose 'Reading a vocabulary:'
columns kind words "read in [ms]" target met
all=
for s in $sets vtm_virtual_house; do all="$all $(folder_of "$s")"; done
for kind in binary float; do
  say "learning many $kind words"
  # shellcheck disable=SC2086
  $placegraph train vocabulary $all --out "$vocabularies/many-$kind.pgw" --kind $kind --words 100000 --descriptors 300000 --force > "$out/vocabulary.log" 2>&1
  for file in "$vocabularies/$kind-corridor_milford.pgw" "$vocabularies/many-$kind.pgw"; do
    info=$($placegraph places vocabulary "$file")
    ms=$(echo "$info" | sed 's/.*read in \([0-9]*\) ms/\1/')
    cells $kind "$(echo "$info" | sed 's/.*: \([0-9]*\) .* words,.*/\1/')" "$ms" "<= 300" "$(verdict "$ms" "<=" 300)"
  done
done

# Table of a stress run from the lines of stress_run (see tests/stress/stress_main.cpp); exit 1 when what the
# test requires is broken.
function list(seeds,   n, part, i, text) {
  n = split(seeds, part, " ")
  for (i = 1; i <= n && i <= 30; ++i) text = text " " part[i]
  return text (n > 30 ? " ... (" n ")" : "")
}
$1 == "done" {
  ++done; reached += $3; if ($3) ++rule[$4]; else { ++ended[$4]; seeds[$4] = seeds[$4] " " $2 }
  points += $5; uncovered += $6; if ($5 > 0) ++covered
  if ($7 > residual) { residual = $7; where = $2 }
  inertia += $8; undecided += $9; if ($10 > stretch) stretch = $10
  time += $11; if ($11 > slowest) { slowest = $11; slow = $2 }
}
$1 == "fail" {
  kind = $3; sub(":$", "", kind)
  if (!((kind, $2) in seen)) { seen[kind, $2] = 1; ++failed[kind]; who[kind] = who[kind] " " $2 }
  if (!($2 in bad)) { bad[$2] = 1; ++all_bad }
}
END {
  printf "models drawn                %d of %d\n", done, wanted
  printf "reached a stop rule         %d (%.2f %%)\n", reached, done ? 100 * reached / done : 0
  for (code in rule) printf "  %-24s  %d\n", code, rule[code]
  printf "ended with a code           %d\n", done - reached
  for (code in ended) printf "  %-24s  %d: %s\n", code, ended[code], list(seeds[code])
  printf "models whose checks failed  %d\n", all_bad
  for (kind in failed) printf "  %-24s  %d: %s\n", kind, failed[kind], list(who[kind])
  printf "points checked              %d of %d, in %d models\n", points, points + uncovered, covered
  printf "worst residual / tolerance  %.3g (seed %s)\n", residual, where
  printf "inertia counted             %d points, %d undecided (%.2f %%)\n", inertia, undecided, inertia ? 100 * undecided / inertia : 0
  printf "largest distance / arc      %.3g\n", stretch
  printf "solution time               %.1f s, slowest %.1f s (seed %s)\n", time, slowest, slow
  if (all_bad > 0 || done < wanted || reached < 0.999 * done) { print "NOT MET"; exit 1 }
  print "met"
}

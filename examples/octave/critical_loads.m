% Critical load of a column on an elastic base over the stiffness of the base.
% Needs snapthrough_solve.oct (see snapthrough_solve.cc) on the path; run in this folder.
request = fileread ("../column_winkler.json");
for stiffness = [10 20 40]
  varied = strrep (request, '"stiffness": 10', sprintf ('"stiffness": %.17g', stiffness));
  result = jsondecode (snapthrough_solve (varied));
  printf ("%g %.17g\n", stiffness, result.summary.critical_load_factor);
end

% read_hdf5.m TRACE.h5 TRACE.csv EVENTS.csv: Octave finds in the first what stands in the second.
arguments = argv();
warning("off", "all");  % tables of texts, which it does not know, are left out
trace = load(arguments{end - 2});
[header, numbers] = deal(fgetl(fopen(arguments{end - 1})), dlmread(arguments{end - 1}, ",", 1, 0));
assert(trace.time(:), numbers(:, 1));
names = strsplit(header, ",")(2:end);
assert(numel(fieldnames(trace.channels)), numel(names));
for i = 1:numel(names)
  field = strrep(strsplit(names{i}, " "){1}, ".", "_");
  if (isdigit(field(1)))
    field = ["_" field];
  endif
  assert(trace.channels.(field)(:), numbers(:, i + 1));
end
disp("equal");

function results = howl_results(folder)
% HOWL_RESULTS  Loads every result that howl wrote to a folder into one struct.
%
%   results = howl_results('out/first_rig')
%
% A file NAME.json becomes results.NAME, as jsondecode has it: results.solution.experiments(1).xi.
% A file NAME.csv becomes results.NAME_table, with a field for each column: a column vector of
% doubles (NaN where a cell is empty), of logicals, or a cell array of texts:
% results.characteristics_table.frequency_hz. Units are in the names; N and M are in units of p per
% unit of q times rad/s. Fields whose names MATLAB does not allow are made valid ones.
%
% Works in MATLAB (R2016b or later) and in Octave (7 or later, whose jsondecode misses the last bit
% of some numbers; tables are exact in both).

  if exist(folder, 'dir') ~= 7
    error('howl_results:folder', '%s: there is no such folder, expected one that howl wrote', folder);
  end
  results = struct();
  files = dir(fullfile(folder, '*.json'));
  for i = 1:numel(files)
    [~, name] = fileparts(files(i).name);
    text = read_text(fullfile(folder, files(i).name));
    results.(field_name(name)) = jsondecode(text);
  end
  files = dir(fullfile(folder, '*.csv'));
  for i = 1:numel(files)
    [~, name] = fileparts(files(i).name);
    results.([field_name(name) '_table']) = read_table(fullfile(folder, files(i).name));
  end
  if isempty(fieldnames(results))
    error('howl_results:empty', '%s: no result is there, expected .json and .csv of howl', folder);
  end
end

function name = field_name(text)
  name = regexprep(text, '[^A-Za-z0-9_]', '_');
  if isempty(regexp(name, '^[A-Za-z]', 'once'))
    name = ['x' name];
  end
end

function text = read_text(path)
  [file, message] = fopen(path, 'r', 'n', 'UTF-8');
  if file < 0
    error('howl_results:file', '%s: %s', path, message);
  end
  text = fread(file, [1 Inf], 'char=>char');
  fclose(file);
end

% howl quotes no cell and breaks none over lines: no name in them has a comma.
function table = read_table(path)
  text = strrep(read_text(path), sprintf('\r'), '');
  if ~isempty(text) && text(end) == sprintf('\n')
    text(end) = [];
  end
  first = find(text == sprintf('\n'), 1);
  if isempty(first)
    first = numel(text) + 1;
  end
  names = regexp(text(1:first - 1), ',', 'split');
  cells = regexp(text(first + 1:end), '[,\n]', 'split');
  if first >= numel(text)
    cells = {};
  end
  if mod(numel(cells), numel(names)) ~= 0
    error('howl_results:table', '%s: its rows have different numbers of cells', path);
  end
  cells = reshape(cells, numel(names), []).';
  table = struct();
  for k = 1:numel(names)
    table.(field_name(names{k})) = column(cells(:, k));
  end
end

function values = column(cells)
  is_empty = cellfun('isempty', cells);
  is_logical = strcmp(cells, 'true') | strcmp(cells, 'false');
  if ~isempty(cells) && all(is_logical)
    values = strcmp(cells, 'true');
    return;
  end
  values = str2double(cells);
  if any(isnan(values) & ~is_empty & ~strcmpi(cells, 'nan'))
    values = cells;
  end
  if isempty(values)
    values = zeros(0, 1);
  end
end

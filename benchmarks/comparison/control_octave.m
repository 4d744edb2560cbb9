% Poles, zeros, frequency responses and the linear simulation by Octave's package control.
% Usage: octave-cli control_octave.m FOLDER ROWS
1;

% Least processor time of five times as many runs as take a tenth of a second, per run.
function [least_s, result] = timed (run)
  runs = 1;
  begin_s = cputime ();
  result = run ();
  least_s = cputime () - begin_s;
  if least_s > 1
    return
  end
  runs = max (1, ceil (0.1 / max (least_s, 1e-3)));
  for repetition = 1:5
    begin_s = cputime ();
    for k = 1:runs
      result = run ();  % without an output lsim plots
    end
    least_s = min (least_s, (cputime () - begin_s) / runs);
  end
end

function row = printed (work, processor_s, error_of_it)
  row = struct ("work", work, "processor_s", processor_s, "error", error_of_it);
  printf ("%-64s %9.4g ms  error %.3g\n", work, 1e3 * processor_s, error_of_it);
  fflush (stdout);
end

function matrix = read_matrix (path, size_of_it)
  file = fopen (path, "rb");
  entries = reshape (fread (file, Inf, "double"), [], 3);
  fclose (file);
  matrix = full (sparse (entries(:, 1) + 1, entries(:, 2) + 1, entries(:, 3), ...
                         size_of_it, size_of_it));
end

% Ten frequencies above the rigid rotation's, whose poles are 0 but for rounding. [Hz]
function found = frequencies_Hz (roots)
  found = sort (imag (roots)) / (2 * pi);
  found = found(found > 1)(1:10);
end

function one = system_of (part)
  states = numel (part.b);
  one = ss (part.a, reshape (part.b, states, 1), reshape (part.c, [], states), ...
            reshape (part.d, [], 1));
end

function rows = roots_rows (folder, root)
  known = jsondecode (fileread (fullfile (root, "tests", "reference", "exact.json"))).paper;
  elements = 29;
  size_of_it = 2 * elements + 1;
  name = fullfile (folder, sprintf ("elements-%d", elements));
  stiffness = read_matrix ([name "-stiffness.f64"], size_of_it);
  mass = read_matrix ([name "-mass.f64"], size_of_it);
  torque = eye (size_of_it, 1);
  nothing = zeros (size_of_it);
  arm = ss ([nothing, eye(size_of_it); -mass \ stiffness, nothing], ...
            [zeros(size_of_it, 1); mass \ torque], [torque', zeros(1, size_of_it)], 0);
  [spent_s, found] = timed (@() {pole(arm), zero(arm)});
  relative = [frequencies_Hz(found{1}) ./ str2double(known.pole_hz);
              frequencies_Hz(found{2}) ./ str2double(known.hub_zero_hz)] - 1;
  rows = {printed(sprintf ("pole and zero elements:%d", elements), spent_s, max (abs (relative)))};
end

function rows = response_rows (folder)
  document = jsondecode (fileread (fullfile (folder, "responses.json")));
  exact = document.real_rad_per_N_m + 1i * document.imaginary_rad_per_N_m;
  rows = {};
  for k = 1:numel (document.systems)
    part = document.systems(k);
    arm = system_of (part);
    [spent_s, found] = timed (@() freqresp (arm, document.omega_rad_per_s));
    rows{end + 1} = printed (sprintf ("freqresp modes:%d", part.modes), spent_s, ...
                             max (abs (found(:) ./ exact - 1)));
  end
end

function rows = simulation_rows (folder)
  document = jsondecode (fileread (fullfile (folder, "simulation.json")));
  arm = system_of (document);
  % By itself lsim takes the torque to be linear between samples.
  [spent_s, found] = timed (@() lsim (c2d (arm, document.sample_time_s, "zoh"),
                                      document.torque_N_m));
  flexarm = document.channels';
  difference = max (abs (found - flexarm)) ./ max (abs (flexarm));
  rows = {printed(sprintf ("lsim modes:%d", document.modes), spent_s, max (difference))};
end

pkg load control
words = argv ();
folder = words{end - 1};
rows_file = words{end};
root = fileparts (fileparts (fileparts (mfilename ("fullpathext"))));
rows = [roots_rows(folder, root), response_rows(folder), simulation_rows(folder)];
version_of_control = pkg ("list", "control"){1}.version;
file = fopen ([rows_file ".tmp"], "w");
fputs (file, jsonencode (struct ("tool", ["Octave " version() ", control " version_of_control], ...
                                 "rows", {rows})));
fclose (file);
rename ([rows_file ".tmp"], rows_file);

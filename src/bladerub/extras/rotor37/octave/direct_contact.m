% Integrate one case of direct contact by NLstep: octave-cli direct_contact.m NLSTEP CASE.mat RESULT.mat
% NLSTEP is the folder with sim_contact3D.m.
paths = argv();
addpath(fileparts(mfilename('fullpath')), paths{1});
given = load(paths{2});
model = CMS_ROM(given);
for node = 1:size(given.gap, 1)
  slip = given.sliding_speed(node);
  gap = given.gap(node, :);
  opening = given.opening_speed(node, :);
  model.nonlinear_elements{node} = struct( ...
    'type', '3D', ...
    'frictionCoefficient', given.friction, ...
    'imposedGap', @(t) gap, ...
    'imposedGapVelocity', @(t) [opening; slip * ones(1, numel(t)); zeros(1, numel(t))]);
end
rest = zeros(model.n, 1);
[displacement, ~, force, ~, solver] = sim_contact3D(given.time, rest, rest, model, struct('verbosity', 0));
inward = displacement(1, :);
in_contact = any(force(1:3:end, :) > 0, 1);
converged = all(solver.IEx);
save('-v7', paths{3}, 'inward', 'in_contact', 'converged');

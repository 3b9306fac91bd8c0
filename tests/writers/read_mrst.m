% SPDX-FileCopyrightText: 2026 The wellknit authors
% SPDX-License-Identifier: GPL-3.0-or-later
% Loads a file by the shipped loader, checks the geometry by itself and prints the arrays, one a line: name, count, values.
function read_mrst(file)
  [G, rock, T, N, W] = wellknit_mrst(file, 1e7);
  [normal, moment] = face_integrals(G);
  % Of the areas, and the rounding of coordinates times the size of a face.
  extent = max(abs(G.nodes.coords(:)));
  scale = G.faces.areas + 1e-2 * extent * sqrt(G.faces.areas);
  off = max(sqrt(sum((normal - G.faces.normals) .^ 2, 2)) ./ scale);
  off = max(off, max(abs(sqrt(sum(normal .^ 2, 2)) - G.faces.areas) ./ scale));
  volume = zeros(G.cells.num, 1);
  closure = zeros(G.cells.num, 3);
  listed = zeros(0, 2);
  for side = 1:2
    has = find(G.faces.neighbors(:, side) > 0);
    cell = G.faces.neighbors(has, side);
    listed = [listed; cell, has];
    sign = 3 - 2 * side;
    volume = volume + sign * accumarray(cell, moment(has), [G.cells.num, 1]);
    for axis = 1:3
      closure(:, axis) = closure(:, axis) + sign * accumarray(cell, normal(has, axis), [G.cells.num, 1]);
    end
  end
  owner = repelem((1:G.cells.num)', diff(G.cells.facePos));
  assert(isequal(sortrows([owner, G.cells.faces]), sortrows(listed)), 'the lists of faces are not those of neighbours');
  assert(off < 1e-12, 'normals or areas are off by %g', off);
  assert(max(sqrt(sum(closure .^ 2, 2))) < 1e-9 * max(G.faces.areas), 'a cell is not closed');
  show('volume_difference', max(abs(volume ./ G.cells.volumes - 1)));
  assert(G.cells.num == numel(rock.poro) && isequal(G.type, {'wellknit', 'processGRDECL'}));
  inner = all(G.faces.neighbors > 0, 2);
  assert(isequal([G.faces.neighbors(inner, :); G.nnc.cells], N));
  show('volumes', G.cells.volumes);
  show('centroids', G.cells.centroids');
  show('neighbors', G.faces.neighbors');
  show('areas', G.faces.areas);
  show('perm', rock.perm');
  show('pore_volume', rock.poro .* G.cells.volumes);
  show('N', N');
  show('T', T);
  for i = 1:numel(W)
    assert(W(i).val == 1e7 && numel(W(i).dir) == numel(W(i).cells));
    show(['cells:' W(i).name], W(i).cells);
    show(['WI:' W(i).name], W(i).WI);
  end
end

% Normals times areas, and a third of the integrals of the position over them: all faces of one number of nodes at once.
function [normal, moment] = face_integrals(G)
  p = G.nodes.coords - G.nodes.coords(1, :);
  normal = zeros(G.faces.num, 3);
  moment = zeros(G.faces.num, 1);
  count = diff(G.faces.nodePos);
  for n = unique(count)'
    f = find(count == n);
    loops = reshape(G.faces.nodes(G.faces.nodePos(f) + (0:n - 1)), numel(f), n);
    middle = zeros(numel(f), 3);
    for i = 1:n
      middle = middle + p(loops(:, i), :) / n;
    end
    for i = 1:n
      a = p(loops(:, i), :);
      b = p(loops(:, mod(i, n) + 1), :);
      part = cross(a - middle, b - middle, 2) / 2;
      normal(f, :) = normal(f, :) + part;
      moment(f) = moment(f) + sum(part .* (a + b + middle), 2) / 9;
    end
  end
end

function show(name, values)
  printf('%s %d', name, numel(values));
  printf(' %.17g', values);
  printf('\n');
end

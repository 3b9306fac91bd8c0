% SPDX-FileCopyrightText: 2026 The wellknit authors
% SPDX-License-Identifier: GPL-3.0-or-later
function [G, rock, T, N, W] = wellknit_mrst(file, pressures)
% WELLKNIT_MRST  Loads what `wellknit --write mrst=FILE` wrote, for MRST (and Octave).
%
%   [G, rock, T, N, W] = wellknit_mrst(FILE)
%   [G, rock, T, N, W] = wellknit_mrst(FILE, PRESSURES)
%
% T(i) is the transmissibility (m3) between the cells N(i, :): the faces between two cells in the order of G.faces,
% then the connections without a face (G.nnc). Give both to MRST, which would compute T from the geometry alone:
%   model = GenericBlackOilModel(G, rock, fluid);
%   model.operators = setupOperatorsTPFA(G, rock, 'neighbors', N, 'trans', T);
%
% PRESSURES sets the bottom-hole pressures (Pa): one for all wells, or a struct with a field for each well's name.
  data = load(file);
  G = data.G;
  rock = data.rock;
  T = data.T;
  N = data.N;
  W = [];
  if isfield(data, 'W')
    W = data.W;
  end
  for i = 1:numel(W)
    W(i).status = logical(W(i).status);
    W(i).cstatus = logical(W(i).cstatus);
    if nargin > 1 && isstruct(pressures)
      W(i).val = pressures.(W(i).name);
    elseif nargin > 1
      W(i).val = pressures;
    end
  end
end

% Model with a massless boundary as NLstep's time integration asks for it; it is reduced before it comes here.
classdef CMS_ROM
  properties
    M
    K
    D
    n
    nb
    nonlinear_elements
  end

  methods
    function model = CMS_ROM(given)
      model.M = given.mass;
      model.K = given.stiffness;
      model.D = given.damping;
      model.n = size(given.mass, 1);
      model.nb = 3 * size(given.gap, 1);
    end

    function yes = isMasslessBoundaryROM(model)
      boundary = 1:model.nb;
      yes = nnz(model.M(boundary, :)) == 0 && nnz(model.M(:, boundary)) == 0;
    end
  end
end

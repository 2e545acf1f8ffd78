"""What Exudyn says about a state: constraint residuals and their Jacobian, mass matrix, forces.

Nothing here knows the mechanism; the numbers are Exudyn's own, read out of its solver.
"""

import exudyn as exu
import numpy as np

CURRENT = exu.ConfigurationType.Current


class Equations:
    """Exudyn's equations M q'' + C_q^T lambda = f, c(q) = 0 and their state q, q'."""

    def __init__(self, system):
        self.system = system
        self.solver = exu.MainSolverImplicitSecondOrder()
        settings = exu.SimulationSettings()
        settings.solution.file.write = False
        settings.timeIntegration.generalizedAlpha.computeInitialAccelerations = False
        if not self.solver.InitializeSolver(system, settings):
            raise RuntimeError("Exudyn cannot initialise its solver")
        self.size = self.solver.GetODE2size()
        self.total = self.size + self.solver.GetAEsize()
        self.set_state(np.zeros(self.size), np.zeros(self.size))

    def set_state(self, coordinates, rates):
        self.system.systemData.SetODE2Coordinates(coordinates, CURRENT)
        self.system.systemData.SetODE2Coordinates_t(rates, CURRENT)

    def residual(self, velocity_level=False):
        """Constraints, or their rates, one entry per algebraic equation."""
        self.solver.ComputeAlgebraicEquations(self.system, velocityLevel=velocity_level)
        return np.array(self.solver.GetSystemResidual()[self.size :])

    def jacobian(self):
        """Rates of the constraints by q'. Rows of a joint's free directions are zero."""
        self.solver.SetSystemJacobian(np.zeros((self.total, self.total)))
        self.solver.ComputeJacobianAE(self.system, 1.0, 1.0, 1.0, velocityLevel=False)
        return np.array(self.solver.GetSystemJacobian())[self.size :, : self.size]

    def mass_matrix(self):
        self.solver.SetSystemMassMatrix(np.zeros((self.total, self.total)))
        self.solver.ComputeMassMatrix(self.system, 1.0)
        return np.array(self.solver.GetSystemMassMatrix())[: self.size, : self.size]

    def forces(self):
        """f: springs, dampers, gravity, applied and gyroscopic forces."""
        self.solver.ComputeODE2RHS(self.system)
        return np.array(self.solver.GetSystemResidual()[: self.size])

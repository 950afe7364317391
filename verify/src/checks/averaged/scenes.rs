//! Random states for the checks of the averaged motion.

use crate::averaged_scenes::direction;
use crate::prelude::*;

/// A body, principal values of a traceless tensor, and `n` and `L` in its principal frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct State {
    pub(super) body: RigidSpheroid<f64>,
    pub(super) s: Vector3<f64>,
    pub(super) n: Vector3<f64>,
    pub(super) momentum: Vector3<f64>,
}

impl State {
    pub(super) fn random(random: &mut Random) -> Self {
        let s = Vector3::from_fn(|_, _| random.within(-1.0, 1.0));
        let s = s.map(|value| value - s.mean());
        let (n, l) = (direction(random), direction(random));
        let momentum = l * random.within(0.5, 3.0);
        let mut body = RigidSpheroid::in_units_of_tc(1.1);
        body.inertia_xx = random.within(0.5, 2.0);
        body.constant_c = random.within(0.5, 2.0);
        Self { body, s, n, momentum }
    }

    /// With the principal values times `factor` and an arbitrary `e_x`.
    pub(super) fn problem(&self, factor: f64) -> Result<Problem<f64>, Error> {
        let equatorial_axis = self.n.cross(&Vector3::new(0.3, -0.5, 0.8)).normalize();
        let state = BodyState { axis: self.n, momentum: self.momentum, equatorial_axis };
        Problem::new(self.body, PrincipalCoefficients::new((self.s * factor).into()).tensor(), state)
    }
}

/// Largest difference of n, e_x and L; L in units of its size.
pub(super) fn difference(a: &BodyState<f64>, b: &BodyState<f64>) -> f64 {
    largest_difference(a, b, b.momentum.norm())
}

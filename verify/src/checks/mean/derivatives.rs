//! Derivatives of the averaged motion by duals.

use nalgebra::{Matrix3, Rotation3, Vector3};
use num_dual::Dual64;
use twofold::dynamics::BodyState;
use twofold::lorentz_violation::{PrincipalCoefficients, principal_frame_along, principal_frame_with_derivatives};
use twofold::propagation::{AveragedMotion, Motion};
use twofold::solutions::averaged::{AveragedSolution, AveragingOrder};

use crate::check::{Bound, Check, Kind, Measured, Worst, largest};
use crate::mean_scenes::MeanScene;
use crate::random::Random;

/// Checks of this subject.
pub(super) fn checks() -> Vec<Check> {
    vec![Check {
        id: "mean-derivatives",
        kind: Kind::Autodiff,
        equations: &[25],
        statement: "the averaged motion in any frame over duals has the derivatives that differences of it have: by s^IJ (two equal eigenvalues, split along their axes or any others, included), L, n and the moments of inertia",
        figure: "largest |dual - difference| / largest component of the derivative, 60 random motions, 24 of them with two equal eigenvalues, of five parameters",
        bound: Bound::AtMost(1e-8),
        reason: "differences of fourth order in steps of 1e-3 of the scale of change: 1e-14 / 1e-3 by rounding, 1e-12 / 30 times a fifth derivative of some hundred",
        measure: derivatives,
    }]
}

/// Eigenvalues and the rotation to the principal frame.
type Frame<S> = fn(&Matrix3<S>) -> Result<(PrincipalCoefficients<S>, Matrix3<S>), twofold::Error>;

/// A scene as a function of one number.
struct Family {
    scene: MeanScene,
    frame: Matrix3<f64>,
    kind: usize,
    equal: bool,
    direction: Vector3<f64>,
}

impl Family {
    /// Two equal values that part along their axes are also tried without a frame.
    fn at<S: twofold::Real>(&self, x: S, t: S, frame_of: Frame<S>) -> Result<BodyState<S>, twofold::Error> {
        let lift = |v: &Vector3<f64>| v.map(S::from_f64);
        let MeanScene { spheroid, s, initial, end } = &self.scene;
        let mut body = spheroid.map(S::from_f64);
        let frame = self.frame.map(S::from_f64);
        let mut tensor = frame * Matrix3::from_diagonal(&lift(s)) * frame.transpose();
        let mut state = BodyState {
            axis: frame * lift(&initial.axis),
            momentum: frame * lift(&initial.momentum),
            equatorial_axis: frame * lift(&initial.equatorial_axis),
        };
        let direction = lift(&self.direction);
        match self.kind {
            // Values along the principal axes: two equal ones part.
            0 if self.equal => {
                let values = lift(s) + direction * S::from_f64(s.amax()) * x;
                let initial = state.rotated(&frame.transpose());
                let coefficients = PrincipalCoefficients::new(values.into());
                return Ok(AveragedSolution::new(&body, &coefficients, &initial, AveragingOrder::Second)?.state(t));
            }
            0 => tensor += frame * Matrix3::from_diagonal(&(direction * S::from_f64(s.amax()))) * frame.transpose() * x,
            // The axes turn as well.
            1 => {
                let v = direction * S::from_f64(s.amax());
                tensor += v * direction.transpose() * x;
            }
            2 => state.momentum += direction * x,
            3 => body.inertia_zz += x,
            _ => {
                let angle = direction * x;
                let turned = |v: &Vector3<S>| v + angle.cross(v);
                (state.axis, state.equatorial_axis) = (turned(&state.axis), turned(&state.equatorial_axis));
                let size = twofold::numerics::scalar::length(&state.axis);
                state.axis /= size;
                let across = state.equatorial_axis - state.axis * state.axis.dot(&state.equatorial_axis);
                state.equatorial_axis = across / twofold::numerics::scalar::length(&across);
            }
        }
        let principal = frame_of(&tensor)?;
        AveragedMotion::in_frame_from_parts(&body, &tensor, &state, (0.0, *end), AveragingOrder::Second, principal)?
            .state(t)
    }

    fn components<S: twofold::Real>(&self, x: S, frame_of: Frame<S>) -> Result<[S; 9], twofold::Error> {
        let state = self.at(x, S::from_f64(self.scene.end), frame_of)?;
        let vectors = [state.axis, state.momentum, state.equatorial_axis];
        Ok(core::array::from_fn(|i| vectors[i / 3][i % 3]))
    }
}

fn derivatives() -> Result<Measured, String> {
    let mut worst = Worst::default();
    let mut random = Random::with_seed(61);
    for number in 0..60_u64 {
        // Half of them with two equal principal values, none where L is on an axis or within 1e-4 of the separatrix.
        let mut scene = MeanScene::draw(17, 6 * number + [0, 1, 3, 4, 5][(number % 5) as usize], 300.0);
        let l = Vector3::new(0.5 + random.within(0.0, 0.3), 0.3 + random.within(0.0, 0.2), 0.6);
        scene.initial.momentum = l.normalize() * scene.initial.momentum.norm();
        let frame =
            Rotation3::from_euler_angles(random.within(-3.0, 3.0), random.within(-1.5, 1.5), random.within(-3.0, 3.0))
                .into_inner();
        for kind in 0..5 {
            let equal = number % 5 < 2;
            let direction = Vector3::from_fn(|_, _| random.within(-1.0, 1.0));
            let family = Family { scene: scene.clone(), frame, kind, equal, direction };
            let found = family.components(Dual64::new(0.0, 1.0), principal_frame_along)?;
            // The state changes by a part of itself while the parameter changes by this much.
            let size = largest(found.iter().map(|x| x.eps.abs())).max(1.0);
            let step = 5e-4 / size;
            let at = |x: f64| family.components(x * step, principal_frame_with_derivatives).map_err(String::from);
            let [a, b, c, d] = [at(-2.0)?, at(-1.0)?, at(1.0)?, at(2.0)?];
            let off = (0..9).map(|i| {
                let difference = ((a[i] - d[i]) + (c[i] - b[i]) * 8.0) / (12.0 * step);
                (difference - found[i].eps).abs()
            });
            worst.see(largest(off) / size, || {
                format!("motion {number} of seed 17, parameter {kind}, direction {direction:?}")
            });
        }
    }
    worst.finish()
}

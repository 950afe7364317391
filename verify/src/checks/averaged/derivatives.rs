//! Derivatives of the averaged motion, computed with duals.

use twofold::lorentz_violation::{principal_frame_along, principal_frame_with_derivatives};
use twofold::numerics::scalar::length;

use crate::averaged_scenes::AveragedScene;
use crate::prelude::*;

checks! {
    /// derivatives of the averaged motion by duals agree with finite differences in any frame: by s^IJ (also for two equal eigenvalues, split
    /// along their axes or any others), L, n, both moments of inertia and C
    Autodiff "mean-derivatives" [25]: derivatives;
    AtMost(1e-8) "largest |dual - difference| / largest component of the derivative, 60 random motions, 24 of them with two equal eigenvalues, of \
     seven parameters";
    because "differences of fourth order in steps of 1e-3 of the scale of change: 1e-14 / 1e-3 by rounding, 1e-12 / 30 times a fifth derivative of \
     some hundred";
}

/// Eigenvalues and the rotation to the principal frame.
type Frame<S> = fn(&Matrix3<S>) -> Result<(PrincipalCoefficients<S>, Matrix3<S>), Error>;

/// A scene as a function of one number.
struct Family {
    scene: AveragedScene,
    frame: Matrix3<f64>,
    kind: usize,
    equal: bool,
    direction: Vector3<f64>,
}

impl Family {
    /// Equal values that separate along their axes are also tried without a frame.
    fn at<S: Real>(&self, x: S, t: S, frame_of: Frame<S>) -> Result<BodyState<S>, Error> {
        let (frame, direction) = (self.frame.map(S::from_f64), self.direction.map(S::from_f64));
        let principal: Problem<S> = self.scene.problem.map(S::from_f64);
        let size = S::from_f64(self.scene.principal_values().amax());
        let along_axes = Matrix3::from_diagonal(&(direction * size)) * x;
        if self.kind == 0 && self.equal {
            let parted =
                Problem::new(*principal.spheroid(), principal.coefficients() + along_axes, *principal.initial())?;
            return Ok(AveragedSolution::new(&parted, AveragingOrder::Second)?.state(t));
        }
        let problem = principal.rotated(&frame);
        let (mut body, mut tensor, mut state) = (*problem.spheroid(), *problem.coefficients(), *problem.initial());
        match self.kind {
            // Eigenvalues along the principal axes.
            0 => tensor += frame * along_axes * frame.transpose(),
            // The axes turn as well.
            1 => tensor += direction * size * direction.transpose() * x,
            2 => state.momentum += direction * x,
            3 => body.inertia_zz += x,
            4 => body.inertia_xx += x,
            5 => body.constant_c += x,
            _ => {
                let angle = direction * x;
                let turned = |v: &Vector3<S>| v + angle.cross(v);
                (state.axis, state.equatorial_axis) = (turned(&state.axis), turned(&state.equatorial_axis));
                state.axis /= length(&state.axis);
                let across = state.equatorial_axis - state.axis * state.axis.dot(&state.equatorial_axis);
                state.equatorial_axis = across / length(&across);
            }
        }
        let principal = frame_of(&tensor)?;
        let span = (0.0, self.scene.end);
        AveragedMotion::in_frame(&Problem::new(body, tensor, state)?, span, principal)?.state(t)
    }

    fn components<S: Real>(&self, x: S, frame_of: Frame<S>) -> Result<[S; 9], Error> {
        let vectors = self.at(x, S::from_f64(self.scene.end), frame_of)?.vectors();
        Ok(core::array::from_fn(|i| vectors[i / 3][i % 3]))
    }
}

fn derivatives() -> Result<Measured, String> {
    let mut random = Random::with_seed(61);
    worst_of(0..60_u64, |&number| {
        // Two in five have two equal principal values. In none is L on an axis or within 1e-4 of the separatrix.
        let mut scene = AveragedScene::draw(17, 6 * number + [0, 1, 3, 4, 5][(number % 5) as usize], 300.0);
        let start = scene.problem.initial();
        let l = Vector3::new(0.5 + random.within(0.0, 0.3), 0.3 + random.within(0.0, 0.2), 0.6);
        let momentum = l.normalize() * start.momentum.norm();
        scene.problem = scene.problem.starting_from(BodyState { momentum, ..*start })?;
        let frame =
            Rotation3::from_euler_angles(random.within(-3.0, 3.0), random.within(-1.5, 1.5), random.within(-3.0, 3.0))
                .into_inner();
        let mut most = 0.0;
        for kind in 0..7 {
            let direction = Vector3::from_fn(|_, _| random.within(-1.0, 1.0));
            let family = Family { scene, frame, kind, equal: number % 5 < 2, direction };
            let found = family.components(Dual64::new(0.0, 1.0), principal_frame_along)?;
            // A change of the parameter by 1 / size changes the state by about its own size.
            let size = largest(found.iter().map(|x| x.eps.abs())).max(1.0);
            let step = 5e-4 / size;
            let at = |x: f64| family.components(x * step, principal_frame_with_derivatives);
            let [a, b, c, d] = [at(-2.0)?, at(-1.0)?, at(1.0)?, at(2.0)?];
            let off = (0..9).map(|i| {
                let difference = ((a[i] - d[i]) + (c[i] - b[i]) * 8.0) / (12.0 * step);
                (difference - found[i].eps).abs()
            });
            most = largest([most, largest(off) / size]);
        }
        Ok(most)
    })
}

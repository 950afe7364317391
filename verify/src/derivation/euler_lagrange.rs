//! The Euler-Lagrange equations from the Lagrangian alone.

use crate::prelude::*;

/// `d/dt (dL/dq') - dL/dq` for `q = alpha, beta, gamma`, at any angles, rates and accelerations.
///
/// The infinitesimal `e1` shifts one rate (or one angle), `e2` carries the motion in time, so the first term is the
/// coefficient of `e1 e2` and no derivative is written by hand.
pub fn euler_lagrange<F: Differentiable>(
    spheroid: &RigidSpheroid<F>,
    s: &PrincipalCoefficients<F>,
    q: &EulerAngles<F>,
    v: &EulerRates<F>,
    a: &EulerRates<F>,
) -> [F; 3] {
    let spheroid = spheroid.map(F::constant);
    let s = PrincipalCoefficients::new([s.xx, s.yy, s.zz].map(F::constant));
    [0, 1, 2].map(|i| {
        let unit = |j| if i == j { F::one() } else { F::zero() };
        let by = |angle_shift: F, rate_shift: F| {
            let angle = |j, q, v| F::second(q, unit(j) * angle_shift, v, F::zero());
            let rate = |j, v, a| F::second(v, unit(j) * rate_shift, a, F::zero());
            let angles = EulerAngles {
                alpha: angle(0, q.alpha, v.alpha),
                beta: angle(1, q.beta, v.beta),
                gamma: angle(2, q.gamma, v.gamma),
            };
            let rates = EulerRates {
                alpha: rate(0, v.alpha, a.alpha),
                beta: rate(1, v.beta, a.beta),
                gamma: rate(2, v.gamma, a.gamma),
            };
            lagrangian(&spheroid, &s, &angles, &rates)
        };
        F::derivative_12(by(F::zero(), F::one())) - F::derivative_1(by(F::one(), F::zero()))
    })
}

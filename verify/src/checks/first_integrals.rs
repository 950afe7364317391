//! What a motion conserves. Eq. (24), the third integral and the two of the geometry.

use nalgebra::Matrix3;
use twofold::dynamics::BodyState;
use twofold::dynamics::equations_of_motion::{body_state_rates, reduced_rates};
use twofold::dynamics::first_integrals::{energy_in_angles, first_integrals, spin_in_angles, symmetric_adjugate};

use crate::check::{Check, Kind};
use crate::derivation::spheroid_motion::{accelerations, fixed_coefficients, fixed_spheroid};
use crate::derivation::{Differentiable, moving_angles, moving_rates};
use crate::identity::{self, Identity};
use crate::random::Point;

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    [
        identity::checks::<IntegralsInAngles>(),
        identity::checks::<IntegralsOfState>(),
        identity::checks::<GeometricIntegrals>(),
        identity::checks::<SameIntegrals>(),
        identity::checks::<OtherClebschForm>(),
        identity::checks::<Adjugate>(),
    ]
    .concat()
}

struct IntegralsInAngles;

impl Identity for IntegralsInAngles {
    const ID: &'static str = "integrals-along-angles";
    const ROUNDED: (Kind, &'static str) = (Kind::Autodiff, "integrals-along-angles-autodiff");
    const EQUATIONS: &'static [u8] = &[24, 25];
    const STATEMENT: &'static str = "E, Omega^z and K do not change along the field of Eq. (25)";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let (q, v) = (&p.angles, &p.rates);
        let a = accelerations(&p.spheroid, &p.s, q, v);
        let (angles, rates) = (moving_angles(q, v), moving_rates(v, &a));
        let (spheroid, s) = (fixed_spheroid(&p.spheroid), fixed_coefficients(&p.s));
        let state = BodyState::from_angles(&spheroid, &angles, &rates);
        [
            energy_in_angles(&spheroid, &s, &angles, &rates),
            spin_in_angles(&angles, &rates),
            first_integrals(&spheroid, &s.tensor(), &state).clebsch,
        ]
        .map(F::derivative)
        .to_vec()
    }
}

struct IntegralsOfState;

impl Identity for IntegralsOfState {
    const ID: &'static str = "integrals-along-state";
    const ROUNDED: (Kind, &'static str) = (Kind::Autodiff, "integrals-along-state-autodiff");
    const EQUATIONS: &'static [u8] = &[24];
    const STATEMENT: &'static str =
        "E, Omega^z and K do not change along the regular equations, for s^IJ in any inertial frame";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let state = BodyState::from_angles(&p.spheroid, &p.angles, &p.rates);
        let moving = moving_state(&state, &body_state_rates(&p.spheroid, &p.s_inertial, &state));
        let integrals = first_integrals(&fixed_spheroid(&p.spheroid), &p.s_inertial.map(F::fixed), &moving);
        [integrals.energy, integrals.spin, integrals.clebsch].map(F::derivative).to_vec()
    }
}

struct GeometricIntegrals;

impl Identity for GeometricIntegrals {
    const ID: &'static str = "geometric-integrals";
    const ROUNDED: (Kind, &'static str) = (Kind::Autodiff, "geometric-integrals-autodiff");
    const EQUATIONS: &'static [u8] = &[24, 61];
    const STATEMENT: &'static str = "n.n, L.n, e_x.e_x and e_x.n do not change along the regular equations";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let state = BodyState::from_angles(&p.spheroid, &p.angles, &p.rates);
        let rates = body_state_rates(&p.spheroid, &p.s_inertial, &state);
        let (n, l, e) = {
            let moving = moving_state(&state, &rates);
            (moving.axis, moving.momentum, moving.equatorial_axis)
        };
        let (axis_rate, momentum_rate) = reduced_rates(&p.spheroid, &p.s_inertial, &state.axis, &state.momentum);
        let mut out = [n.dot(&n), l.dot(&n), e.dot(&e), e.dot(&n)].map(F::derivative).to_vec();
        out.extend(&(axis_rate - rates.axis));
        out.extend(&(momentum_rate - rates.momentum));
        out
    }
}

fn moving_state<F: Differentiable>(state: &BodyState<F>, rates: &BodyState<F>) -> BodyState<F::First> {
    BodyState {
        axis: state.axis.zip_map(&rates.axis, F::first),
        momentum: state.momentum.zip_map(&rates.momentum, F::first),
        equatorial_axis: state.equatorial_axis.zip_map(&rates.equatorial_axis, F::first),
    }
}

struct SameIntegrals;

impl Identity for SameIntegrals {
    const ID: &'static str = "energy-of-state";
    const ROUNDED: (Kind, &'static str) = (Kind::Property, "energy-of-state-rounding");
    const EQUATIONS: &'static [u8] = &[24];
    const STATEMENT: &'static str = "energy and spin of the regular state are those in Euler angles";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let (q, v) = (&p.angles, &p.rates);
        let integrals = first_integrals(&p.spheroid, &p.s.tensor(), &BodyState::from_angles(&p.spheroid, q, v));
        vec![integrals.energy - energy_in_angles(&p.spheroid, &p.s, q, v), integrals.spin - spin_in_angles(q, v)]
    }
}

struct OtherClebschForm;

impl Identity for OtherClebschForm {
    const ID: &'static str = "clebsch-forms";
    const ROUNDED: (Kind, &'static str) = (Kind::Property, "clebsch-forms-rounding");
    const EQUATIONS: &'static [u8] = &[24];
    const STATEMENT: &'static str = "K = L.(s L) - L.L tr s - 2 C I n.(s s n) + 2 I tr s H - C I (tr^2 s - tr s^2), with H = E without the energy of the \
         conserved spin";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let state = BodyState::from_angles(&p.spheroid, &p.angles, &p.rates);
        let (s, n, l) = (&p.s_inertial, &state.axis, &state.momentum);
        let (moment, c) = (p.spheroid.inertia_xx, p.spheroid.constant_c);
        let trace = s.trace();
        let (s_n, along) = (s * n, l.dot(n));
        let other = l.dot(&(s * l)) - l.dot(l) * trace - c * moment * s_n.dot(&s_n) * 2.0;
        let spin_part = along * along / p.spheroid.inertia_zz - along * along / moment;
        let found = first_integrals(&p.spheroid, s, &state);
        let h = found.energy - spin_part / 2.0;
        let constant = c * moment * (trace * trace - (s * s).trace());
        vec![found.clebsch - (other + moment * trace * h * 2.0 - constant)]
    }
}

struct Adjugate;

impl Identity for Adjugate {
    const ID: &'static str = "symmetric-adjugate";
    const ROUNDED: (Kind, &'static str) = (Kind::Property, "symmetric-adjugate-rounding");
    const EQUATIONS: &'static [u8] = &[24];
    const STATEMENT: &'static str = "adj(s) s = det(s) 1, of the adjugate in the third integral";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let s = &p.s_inertial;
        let determinant = s.column(0).dot(&s.column(1).cross(&s.column(2)));
        let product = symmetric_adjugate(s) * s;
        (product - Matrix3::from_diagonal_element(determinant)).iter().copied().collect()
    }
}

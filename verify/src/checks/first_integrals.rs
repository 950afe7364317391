//! Conserved quantities of a motion. Eq. (24), the third integral and the two geometric constraints.

use crate::derivation::spheroid_motion::{accelerations, fixed_coefficients};
use crate::prelude::*;

checks! {
    /// E, Omega^z and K do not change along the field of Eq. (25)
    integrals_in_angles: Autodiff "integrals-along-angles" [24, 25];
    /// E, Omega^z and K do not change along the regular equations, for s^IJ in any inertial frame
    integrals_of_state: Autodiff "integrals-along-state" [24];
    /// n.n, L.n, e_x.e_x and e_x.n do not change along the regular equations
    geometric_integrals: Autodiff "geometric-integrals" [24, 61];
    /// energy and spin of the regular state are those in Euler angles
    same_integrals: Property "energy-of-state" [24];
    /// K = L.(s L) - L.L tr s - 2 C I n.(s s n) + 2 I tr s H - C I (tr^2 s - tr s^2), with H = E without the energy of the conserved spin
    other_clebsch_form: Property "clebsch-forms" [24];
    /// adj(s) s = det(s) 1, of the adjugate in the third integral
    adjugate_times_s: Property "symmetric-adjugate" [24];
}

fn integrals_in_angles<F: Differentiable>(p: &Point<F>) -> Vec<F> {
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

fn integrals_of_state<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let state = BodyState::from_angles(&p.spheroid, &p.angles, &p.rates);
    let moving = moving_state(&state, &body_state_rates(&p.spheroid, &p.s_inertial, &state));
    let integrals = first_integrals(&fixed_spheroid(&p.spheroid), &p.s_inertial.map(F::fixed), &moving);
    [integrals.energy, integrals.spin, integrals.clebsch].map(F::derivative).to_vec()
}

fn geometric_integrals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let state = BodyState::from_angles(&p.spheroid, &p.angles, &p.rates);
    let rates = body_state_rates(&p.spheroid, &p.s_inertial, &state);
    let [n, l, e] = moving_state(&state, &rates).vectors();
    let (axis_rate, momentum_rate) = reduced_rates(&p.spheroid, &p.s_inertial, &state.axis, &state.momentum);
    components![
        [n.dot(&n), l.dot(&n), e.dot(&e), e.dot(&n)].map(F::derivative),
        axis_rate - rates.axis,
        momentum_rate - rates.momentum,
    ]
}

fn moving_state<F: Differentiable>(state: &BodyState<F>, rates: &BodyState<F>) -> BodyState<F::First> {
    let (at, rates) = (state.vectors(), rates.vectors());
    BodyState::from_vectors([0, 1, 2].map(|i| at[i].zip_map(&rates[i], F::first)))
}

fn same_integrals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (q, v) = (&p.angles, &p.rates);
    let integrals = first_integrals(&p.spheroid, &p.s.tensor(), &BodyState::from_angles(&p.spheroid, q, v));
    vec![integrals.energy - energy_in_angles(&p.spheroid, &p.s, q, v), integrals.spin - spin_in_angles(q, v)]
}

fn other_clebsch_form<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let state = BodyState::from_angles(&p.spheroid, &p.angles, &p.rates);
    let (s, n, l) = (&p.s_inertial, &state.axis, &state.momentum);
    let (moment, c) = (p.spheroid.inertia_xx, p.spheroid.constant_c);
    let trace = s.trace();
    let (s_n, along) = (s * n, l.dot(n));
    let other = l.dot(&(s * l)) - l.dot(l) * trace - c * moment * s_n.dot(&s_n) * 2.0;
    let spin_part = along * along / p.spheroid.inertia_zz - along * along / moment;
    let integrals = first_integrals(&p.spheroid, s, &state);
    let h = integrals.energy - spin_part / 2.0;
    let constant = c * moment * (trace * trace - (s * s).trace());
    vec![integrals.clebsch - (other + moment * trace * h * 2.0 - constant)]
}

fn adjugate_times_s<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let s = &p.s_inertial;
    let determinant = s.column(0).dot(&s.column(1).cross(&s.column(2)));
    components![symmetric_adjugate(s) * s - Matrix3::from_diagonal_element(determinant)]
}

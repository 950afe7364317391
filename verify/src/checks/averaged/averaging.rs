//! The averaged Hamiltonian and the generator of the averaging, computed with duals.

use nalgebra::Unit;
use twofold::numerics::scalar::length;

use super::scenes::State;
use crate::prelude::*;

checks! {
    /// the slopes of the generator of the averaged motion by n and L are its automatic derivatives
    Autodiff "mean-generator-slopes" [25]: slopes_of_generator;
    AtMost(1e-14) "largest difference / (C I^xx |s| / G), 200 random states";
    because "some thirty roundings";
    /// the bracket of the kinetic energy with the generator is the part of the potential that depends on the fast angle
    Autodiff "mean-generator-bracket" [25]: bracket_of_generator;
    AtMost(1e-14) "largest |{L.L / (2 I^xx), W} + V - <V>| / (C |s|), 200 random states";
    because "some thirty roundings";
    /// the closed form of the second order of the mean Hamiltonian, for traceless s, is half the average of {V + <V>, W} over the fast angle, by
    /// duals at nine angles
    Autodiff "mean-hamiltonian-second-order" [25]: second_order;
    AtMost(1e-13) "largest difference / (C^2 I^xx |s|^2 / G^2), 200 random states";
    because "nine brackets of some hundred roundings";
    /// the rates of the frame and of l are those that the mean Hamiltonian generates: w = <H>_L, dL/dt = w x L + <H>_n x n
    Autodiff "mean-frame-rate" [25]: rates_of_frame;
    AtMost(1e-13) "largest difference / (G / I^xx), 200 random states, both orders";
    because "some hundred roundings";
}

trait Function: Fn(&State, &Vector3<Dual64>, &Vector3<Dual64>) -> Dual64 {}

impl<T: Fn(&State, &Vector3<Dual64>, &Vector3<Dual64>) -> Dual64> Function for T {}

fn dual(v: &Vector3<f64>) -> Vector3<Dual64> {
    v.map(Dual64::from_re)
}

/// Slopes by `n` and `L`.
fn slopes_of(f: impl Function, state: &State) -> [Vector3<f64>; 2] {
    [0, 1].map(|place| {
        Vector3::from_fn(|i, _| {
            let mut vectors = [dual(&state.n), dual(&state.momentum)];
            vectors[place][i].eps = 1.0;
            f(state, &vectors[0], &vectors[1]).eps
        })
    })
}

/// `{f, g} = L.(f_L x g_L) + n.(f_L x g_n + f_n x g_L)`.
fn bracket(f: impl Function, g: impl Function, state: &State) -> f64 {
    let [f_n, f_l] = slopes_of(f, state);
    let [g_n, g_l] = slopes_of(g, state);
    state.momentum.dot(&f_l.cross(&g_l)) + state.n.dot(&(f_l.cross(&g_n) + f_n.cross(&g_l)))
}

fn kinetic(state: &State, _: &Vector3<Dual64>, momentum: &Vector3<Dual64>) -> Dual64 {
    momentum.dot(momentum) / (2.0 * state.body.inertia_xx)
}

fn potential(state: &State, n: &Vector3<Dual64>, _: &Vector3<Dual64>) -> Dual64 {
    n.dot(&dual(&state.s).component_mul(n)) * state.body.constant_c
}

/// `<V>`, and its part of second order.
fn averaged_potential(order: AveragingOrder) -> impl Function {
    move |state: &State, n: &Vector3<Dual64>, momentum: &Vector3<Dual64>| {
        let size = length(momentum);
        let l = momentum / size;
        mean_potential(&fixed_spheroid(&state.body), &dual(&state.s), size, n.dot(&l), &l, order)
    }
}

fn of_generator(state: &State, n: &Vector3<Dual64>, momentum: &Vector3<Dual64>) -> Dual64 {
    generator(&fixed_spheroid(&state.body), &dual(&state.s), n, momentum)
}

fn at_random(figure: impl Fn(&State) -> f64) -> Result<Measured, String> {
    worst_of_draws(57, 200, |random| Ok(figure(&State::random(random))))
}

fn slopes_of_generator() -> Result<Measured, String> {
    at_random(|state| {
        let State { body, s, n, momentum } = state;
        let closed = generator_slopes(body, s, n, momentum);
        let by_duals = slopes_of(of_generator, state);
        let size = momentum.norm();
        let unit = body.constant_c * body.inertia_xx * s.norm() / size;
        let [by_axis, by_momentum] = [0, 1].map(|i| largest_component(&(closed[i] - by_duals[i])));
        largest([by_axis, by_momentum * size]) / unit
    })
}

fn bracket_of_generator() -> Result<Measured, String> {
    at_random(|state| {
        let (n, momentum) = (dual(&state.n), dual(&state.momentum));
        let average = averaged_potential(AveragingOrder::First)(state, &n, &momentum);
        let periodic = (potential(state, &n, &momentum) - average).re;
        (bracket(kinetic, of_generator, state) + periodic).abs() / (state.body.constant_c * state.s.norm())
    })
}

fn second_order() -> Result<Measured, String> {
    at_random(|state| {
        let State { body, s, n, momentum } = state;
        let size = momentum.norm();
        let l = momentum / size;
        let mut sum = 0.0;
        for k in 0..9 {
            let turn = Rotation3::from_axis_angle(&Unit::new_normalize(l), TAU * f64::from(k) / 9.0);
            let turned = State { n: turn * n, ..*state };
            sum += bracket(potential, of_generator, &turned)
                + bracket(averaged_potential(AveragingOrder::First), of_generator, &turned);
        }
        let c = n.dot(&l);
        let order = |order| mean_potential(body, s, size, c, &l, order);
        let unit = body.constant_c.powi(2) * body.inertia_xx * s.norm_squared() / (size * size);
        (order(AveragingOrder::Second) - order(AveragingOrder::First) - sum / 18.0).abs() / unit
    })
}

fn rates_of_frame() -> Result<Measured, String> {
    at_random(|state| {
        let State { body, s, n, momentum } = state;
        let size = momentum.norm();
        let l = momentum / size;
        largest([AveragingOrder::First, AveragingOrder::Second].map(|order| {
            let hamiltonian = |state: &State, n: &Vector3<Dual64>, momentum: &Vector3<Dual64>| {
                kinetic(state, n, momentum) + averaged_potential(order)(state, n, momentum)
            };
            let [by_axis, by_momentum] = slopes_of(hamiltonian, state);
            let (about_momentum, tensor, about_axis) = mean_angular_velocity(body, s, size, n.dot(&l), &l, order);
            let pull = tensor.component_mul(&l);
            let w = l * about_momentum + pull + n * about_axis;
            let direction = (by_momentum.cross(momentum) + by_axis.cross(n)) / size;
            let off = [w - by_momentum, pull.cross(&l) - direction].map(|v| largest_component(&v));
            largest(off) / (size / body.inertia_xx)
        }))
    })
}

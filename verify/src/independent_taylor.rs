//! An independent Taylor integrator for true errors: it shares no code with the model, runs on any number type and has no
//! dense output.

use crate::prelude::*;

type Vector<S> = [S; 3];

/// The state after the time `duration` (of either sign) under `s^IJ = s`, with a truncation of about `tolerance` per step in
/// the components of `n`, `e_x` and of `L` in units of its size.
///
/// The recurrences are those of the quadratic equations of motion, `dn/dt = L x n / I^xx`, `dL/dt = 2 C (s n) x n`,
/// `d e_x/dt = Omega x e_x`, written again here.
pub fn state_after<S: Real>(problem: &Problem<f64>, duration: S, tolerance: f64) -> BodyState<S> {
    let (spheroid, s, initial) = (problem.spheroid(), problem.coefficients(), problem.initial());
    let exact = |v: &nalgebra::Vector3<f64>| -> Vector<S> { [v.x, v.y, v.z].map(S::from_f64) };
    let s: [Vector<S>; 3] = [0, 1, 2].map(|i| exact(&s.row(i).transpose()));
    let [xx, zz, c] = [spheroid.inertia_xx, spheroid.inertia_zz, spheroid.constant_c].map(S::from_f64);
    let order = (8.0 - tolerance.log10()) as usize;
    let pull = (spheroid.constant_c.abs()
        * s.map(|row| row.map(S::re)).as_flattened().iter().fold(0.0, |a, b| a + b * b).sqrt()
        * 2.0
        * spheroid.inertia_xx)
        .sqrt();
    let momentum_scale = (initial.momentum.norm() + pull).max(f64::MIN_POSITIVE);
    // n is a unit vector; rounding may have changed its length.
    let axis = exact(&initial.axis);
    let length = axis.iter().fold(S::zero(), |sum, x| sum + *x * *x).sqrt();
    let axis = axis.map(|x| x / length);
    let mut state = [axis, exact(&initial.momentum), exact(&initial.equatorial_axis)];
    let mut left = duration;
    while left.re() != 0.0 {
        let series = coefficients(&s, [xx, zz, c], &state, order);
        let size = |k: usize| {
            let largest = |v: &Vector<S>| v.iter().fold(0.0, |most: f64, x| most.max(x.re().abs()));
            largest(&series[k][0]).max(largest(&series[k][1]) / momentum_scale).max(largest(&series[k][2]))
        };
        let bound = |k: usize| (tolerance / size(k)).powf(1.0 / k as f64);
        let step = bound(order).min(bound(order - 1)).min(left.re().abs()).copysign(duration.re());
        let step = if step.abs() < left.re().abs() { S::from_f64(step) } else { left };
        let mut next = series[order];
        for term in series[..order].iter().rev() {
            for (vector, add) in next.iter_mut().zip(term) {
                for i in 0..3 {
                    vector[i] = vector[i] * step + add[i];
                }
            }
        }
        state = next;
        left -= step;
    }
    let [axis, momentum, equatorial_axis] = state.map(nalgebra::Vector3::from);
    BodyState { axis, momentum, equatorial_axis }
}

/// Taylor coefficients of `n`, `L`, `e_x` up to the given order.
fn coefficients<S: Real>(
    s: &[Vector<S>; 3],
    [xx, zz, c]: [S; 3],
    start: &[Vector<S>; 3],
    order: usize,
) -> Vec<[Vector<S>; 3]> {
    let spin = dot(&start[0], &start[1]) / zz;
    let mut series = vec![*start];
    let (mut pulled, mut turning): (Vec<Vector<S>>, Vec<Vector<S>>) = (vec![], vec![]);
    for k in 0..order {
        let [n, momentum, _] = series[k];
        pulled.push([0, 1, 2].map(|i| dot(&s[i], &n)));
        turning.push([0, 1, 2].map(|i| (momentum[i] - (zz - xx) * spin * n[i]) / xx));
        let mut sums = [[S::zero(); 3]; 3];
        for j in 0..=k {
            let [n, _, e] = &series[k - j];
            add_cross(&mut sums[0], &series[j][1], n);
            add_cross(&mut sums[1], &pulled[j], n);
            add_cross(&mut sums[2], &turning[j], e);
        }
        let share = S::one() / (k + 1) as f64;
        let factors = [share / xx, c * 2.0 * share, share];
        series.push([0, 1, 2].map(|v| sums[v].map(|x| x * factors[v])));
    }
    series
}

fn dot<S: Real>(a: &Vector<S>, b: &Vector<S>) -> S {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn add_cross<S: Real>(sum: &mut Vector<S>, a: &Vector<S>, b: &Vector<S>) {
    for (i, component) in sum.iter_mut().enumerate() {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        *component += a[j] * b[k] - a[k] * b[j];
    }
}

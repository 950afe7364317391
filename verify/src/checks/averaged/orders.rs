//! Both orders of the averaged motion against numerical motion.

use super::scenes::{State, difference};
use crate::prelude::*;

checks! {
    /// with tp-II's geometry and s scaled by k from 1e-1 to 1e-3 n, L and e_x of the first-order averaged motion are off by at most 0.03 k over
    /// 30/k t_c
    Regime "averaged-motion-first-order" [25, 57]:
        || worst_of(SCALES, |&k| Ok(error_of_tp_2(AveragingOrder::First, k)? / k));
    AtMost(0.03) "largest error of a component of n, L or e_x over k";
    because "what the first order leaves out of the rates is of the order of the square of the strength, 0.03 k here: (0.03 k)^2 over 30/k t_c is \
     0.027 k";
    /// at k = 0.1 the error of the averaged motion of second order is at least 20 times smaller than that of first order
    Regime "averaged-motion-second-order" [25, 57]: gain_of_second_order;
    AtMost(0.05) "error of second order / error of first, n, L and e_x, k = 0.1";
    because "one power of C |s| I^xx / G^2 more, 0.003";
    /// the errors of the first and second order of the averaged motion fall with the first and second power of s over times 1/s
    Regime "averaged-motion-slopes" [25, 57]: slopes_of_errors;
    AtMost(0.1) "largest |measured slope - order|, k from 1e-1 to 1e-3";
    because "corrections of relative order k";
    /// with tp-II's geometry and s scaled by k from 1e-1 to 1e-6 the first order is off by at most 0.03 k over 30/k t_c, against motion in
    /// double-double numbers
    Oracle "averaged-motion-reference" [25, 57]: || worst_of(errors_of_reference()?, |(k, [first, _])| Ok(first / k));
    AtMost(0.03) "largest error of a component of n, L or e_x over k, at tenths of the time";
    because "as for averaged-motion-first-order: (0.03 k)^2 over 30/k t_c is 0.027 k";
    /// against the same reference the errors of both orders fall with their powers of s down to k = 1e-5
    Oracle "averaged-motion-reference-slopes" [25, 57]: slopes_of_reference;
    AtMost(0.1) "largest |measured slope - order|, k from 1e-1 to 1e-5";
    because "corrections of relative order k";
    /// the second-order averaged motion holds for random geometries, including single precession with n along L, c^2 = 1/3 and tensors with two
    /// equal values
    Regime "averaged-motion-regular" [25, 26]: random_geometries;
    AtMost(6.0) "largest error of n, L / G or e_x over x^2 (1 + x G t / I^xx), x = C (s_max - s_min) I^xx / G^2, away from the separatrix";
    because "the periodic part of second order and rates of third, with coefficients of order one";
}

const ORDERS: [AveragingOrder; 2] = [AveragingOrder::First, AveragingOrder::Second];

const SCALES: [f64; 5] = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3];

/// tp-II with `s` scaled by `k`.
pub(in crate::checks) fn tp_2(k: f64) -> Result<Problem<f64>, Error> {
    let scene = reference_motion("tp-2");
    Problem::new(scene.spheroid, scene.coefficients.scaled(k).tensor(), scene.initial())
}

/// Largest error of n, L and e_x over 30/k t_c.
fn error_of_tp_2(order: AveragingOrder, k: f64) -> Result<f64, String> {
    let problem = tp_2(k)?;
    let exact = problem.taylor((0.0, 30.0 / k), 1e-13)?;
    let averaged = AveragedSolution::new(&problem, order)?;
    largest_of((0..=200).map(|i| {
        let t = 30.0 / k * f64::from(i) / 200.0;
        Ok(difference(&averaged.state(t), &exact.state(t)?))
    }))
}

fn gain_of_second_order() -> Result<Measured, String> {
    let [first, second] = ORDERS.map(|order| error_of_tp_2(order, 0.1));
    let (first, second) = (first?, second?);
    Ok(Measured::new(second / first, format!("k = 0.1: {second:.2e} and {first:.2e}")))
}

fn slopes_of_errors() -> Result<Measured, String> {
    let errors = |order| errors_at(SCALES, |k| error_of_tp_2(order, k));
    let [first, second] = ORDERS.map(errors);
    largest_off_order([("first", 1.0, first?), ("second", 2.0, second?)])
}

fn random_geometries() -> Result<Measured, String> {
    let mut random = Random::with_seed(59);
    let mut followed = 0;
    let measured = worst_of(0..40, |case| {
        let mut state = State::random(&mut random);
        state.s *= 3e-3;
        match case % 4 {
            0 => state.s.y = state.s.x,
            1 => state.s.z = state.s.y,
            _ => {}
        }
        state.body.inertia_zz = state.body.inertia_xx * random.within(0.5, 1.9);
        let (s, n, l) = (state.s, state.n, state.momentum.normalize());
        let across = (n - l * n.dot(&l)).normalize();
        state.n = match case % 5 {
            0 => l,
            1 => l * (1.0 / 3.0f64).sqrt() + across * (2.0 / 3.0f64).sqrt(),
            2 => (l + across * 1e-3).normalize(),
            _ => n,
        };
        // Small differences grow near the separatrix.
        let mut sorted = [s.x, s.y, s.z];
        sorted.sort_by(f64::total_cmp);
        let distance = (l.dot(&s.component_mul(&l)) - sorted[1]).abs() / (sorted[2] - sorted[0]);
        if distance < 0.1 {
            return Ok(None);
        }
        followed += 1;
        let problem = state.problem(1.0)?;
        let averaged = AveragedSolution::new(&problem, AveragingOrder::Second)?;
        let (x, rate) = (averaged.relative_strength(), state.momentum.norm() / state.body.inertia_xx);
        let end = 3.0 / (x * rate);
        let exact = problem.taylor((0.0, end), 1e-13)?;
        largest_if_any((0..=20).map(|i| {
            let t = (end * f64::from(i) / 20.0).min(end);
            Ok(difference(&averaged.state(t), &exact.state(t)?) / (x * x * (1.0 + x * rate * t)))
        }))
    })?;
    if followed < 25 {
        Err(format!("only {followed} of 40 motions are away from the separatrix"))
    } else {
        Ok(measured)
    }
}

/// States of [`tp_2`] at late times, from `data/mean_reference.csv`: `k`, the time and the state.
pub(in crate::checks) fn late_states_of_tp_2() -> Result<Vec<(f64, f64, BodyState<f64>)>, String> {
    let lines = include_str!("../../../data/mean_reference.csv").lines().filter(|line| !line.starts_with(['#', 'k']));
    lines
        .map(|line| {
            let numbers: Vec<f64> =
                line.split(',').map(|cell| cell.parse().map_err(|_| line.to_owned())).collect::<Result<_, _>>()?;
            let state = BodyState::from_vectors([2, 5, 8].map(|i| Vector3::from_column_slice(&numbers[i..i + 3])));
            Ok((numbers[0], numbers[1], state))
        })
        .collect()
}

/// Errors of both orders by `k`: the largest over the times of the reference.
fn errors_of_reference() -> Result<Vec<(f64, [f64; 2])>, String> {
    let mut errors: Vec<(f64, [f64; 2])> = Vec::new();
    for (k, t, exact) in late_states_of_tp_2()? {
        if errors.last().is_none_or(|(last, _)| *last != k) {
            errors.push((k, [0.0; 2]));
        }
        let (_, most) = errors.last_mut().ok_or("no k")?;
        for (order, most) in ORDERS.into_iter().zip(most) {
            let averaged = AveragedSolution::new(&tp_2(k)?, order)?;
            *most = largest([*most, difference(&averaged.state(t), &exact)]);
        }
    }
    Ok(errors)
}

fn slopes_of_reference() -> Result<Measured, String> {
    let errors: Vec<_> = errors_of_reference()?.into_iter().filter(|(k, _)| *k > 5e-6).collect();
    let of = |place: usize| errors.iter().map(|(k, errors)| (*k, errors[place])).collect();
    largest_off_order([("first", 1.0, of(0)), ("second", 2.0, of(1))])
}

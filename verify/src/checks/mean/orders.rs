//! Both orders of the averaged motion against numerical motion.

use nalgebra::Vector3;
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::propagation::{Motion, propagate};
use twofold::solutions::averaged::{AveragedSolution, AveragingOrder};

use super::scenes::{State, difference, random_state};
use crate::check::{Bound, Check, Kind, Measured, Worst, largest};
use crate::random::Random;
use crate::reference::reference_motion;
use twofold::straight_line::slope;

/// Checks of this subject.
pub(super) fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "averaged-motion-first-order",
            kind: Kind::Regime,
            equations: &[25, 57],
            statement: "with tp-II's geometry and s scaled by k from 1e-1 to 1e-3 n, L and e_x of the first-order averaged motion are off by at most 0.03 k over 30/k t_c",
            figure: "largest error of a component of n, L or e_x over k",
            bound: Bound::AtMost(0.03),
            reason: "asked of it: the periodic part of second order, and the rates of second order over a time 1/k",
            measure: || tp_2(AveragingOrder::First).map(|(measured, _)| measured),
        },
        Check {
            id: "averaged-motion-second-order",
            kind: Kind::Regime,
            equations: &[25, 57],
            statement: "to second order the error is at least 20 times smaller than to first at k = 0.1",
            figure: "error of second order / error of first, n, L and e_x, k = 0.1",
            bound: Bound::AtMost(0.05),
            reason: "one power of C |s| I^xx / G^2 more, 0.003",
            measure: gain_of_second_order,
        },
        Check {
            id: "averaged-motion-slopes",
            kind: Kind::Regime,
            equations: &[25, 57],
            statement: "the errors of the first and second order of the averaged motion fall with the first and second power of s over times 1/s",
            figure: "largest |measured slope - order|, k from 1e-1 to 1e-3",
            bound: Bound::AtMost(0.1),
            reason: "corrections of relative order k",
            measure: slopes_of_errors,
        },
        Check {
            id: "averaged-motion-reference",
            kind: Kind::Oracle,
            equations: &[25, 57],
            statement: "with tp-II's geometry and s scaled by k from 1e-1 to 1e-6 the first order is off by at most 0.03 k over 30/k t_c, against motion in double-double numbers",
            figure: "largest error of a component of n, L or e_x over k, at tenths of the time",
            bound: Bound::AtMost(0.03),
            reason: "asked of it",
            measure: first_order_of_reference,
        },
        Check {
            id: "averaged-motion-reference-slopes",
            kind: Kind::Oracle,
            equations: &[25, 57],
            statement: "and the errors of both orders fall with their powers of s down to 1e-5 k",
            figure: "largest |measured slope - order|, k from 1e-1 to 1e-5",
            bound: Bound::AtMost(0.1),
            reason: "corrections of relative order k",
            measure: slopes_of_reference,
        },
        Check {
            id: "averaged-motion-regular",
            kind: Kind::Regime,
            equations: &[25, 26],
            statement: "the second-order averaged motion holds for random geometries, single precession with n on L, c^2 = 1/3 and tensors with two equal values among them",
            figure: "largest error of n, L / G or e_x over x^2 (1 + x G t / I^xx), x = C (s_max - s_min) I^xx / G^2, away from the separatrix",
            bound: Bound::AtMost(6.0),
            reason: "the periodic part of second order and rates of third, with coefficients of order one; 3.3 was seen",
            measure: random_geometries,
        },
    ]
}

const SCALES: [f64; 5] = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3];

/// Largest error of n, L and e_x over 30/k t_c.
fn error_of_tp_2(order: AveragingOrder, k: f64) -> Result<f64, String> {
    let scene = reference_motion("tp-2");
    let values = [scene.coefficients.xx, scene.coefficients.yy, scene.coefficients.zz].map(|value| value * k);
    let coefficients = PrincipalCoefficients::new(values);
    let initial = scene.initial();
    let exact = propagate(&scene.spheroid, &coefficients.tensor(), &initial, (0.0, 30.0 / k), 1e-13)?;
    let mean = AveragedSolution::new(&scene.spheroid, &coefficients, &initial, order)?;
    let mut most = 0.0;
    for i in 0..=200 {
        let t = 30.0 / k * f64::from(i) / 200.0;
        most = largest([most, difference(&mean.state(t), &exact.state(t)?)]);
    }
    Ok(most)
}

fn tp_2(order: AveragingOrder) -> Result<(Measured, Vec<(f64, f64)>), String> {
    let mut worst = Worst::default();
    let mut errors = Vec::new();
    for k in SCALES {
        let all = error_of_tp_2(order, k)?;
        worst.see(all / k, || format!("k = {k}"));
        errors.push((k.log10(), all.log10()));
    }
    Ok((worst.finish()?, errors))
}

fn gain_of_second_order() -> Result<Measured, String> {
    let mut worst = Worst::default();
    let ratio = error_of_tp_2(AveragingOrder::Second, 0.1)? / error_of_tp_2(AveragingOrder::First, 0.1)?;
    worst.see(ratio, || "k = 0.1".to_owned());
    worst.finish()
}

fn slopes_of_errors() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for (order, expected) in [(AveragingOrder::First, 1.0), (AveragingOrder::Second, 2.0)] {
        let fit = slope(&tp_2(order)?.1)?;
        worst.see((fit.value - expected).abs(), || format!("{order:?}: {:.3} +- {:.3}", fit.value, fit.error));
    }
    worst.finish()
}

fn random_geometries() -> Result<Measured, String> {
    let mut random = Random::with_seed(59);
    let mut worst = Worst::default();
    let mut followed = 0;
    for case in 0..40 {
        let State { mut s, n, momentum, .. } = random_state(&mut random);
        s *= 3e-3;
        match case % 4 {
            0 => s.y = s.x,
            1 => s.z = s.y,
            _ => {}
        }
        let body = RigidSpheroid::in_units_of_tc(random.within(0.5, 1.9));
        let l = momentum.normalize();
        let across = (n - l * n.dot(&l)).normalize();
        let n = match case % 5 {
            0 => l,
            1 => l * (1.0 / 3.0f64).sqrt() + across * (2.0 / 3.0f64).sqrt(),
            2 => (l + across * 1e-3).normalize(),
            _ => n,
        };
        let coefficients = PrincipalCoefficients::new(s.into());
        // Near the separatrix small differences grow.
        let mut sorted = [s.x, s.y, s.z];
        sorted.sort_by(f64::total_cmp);
        let distance = (l.dot(&s.component_mul(&l)) - sorted[1]).abs() / (sorted[2] - sorted[0]);
        if distance < 0.1 {
            continue;
        }
        followed += 1;
        let equatorial_axis = n.cross(&Vector3::new(0.3, -0.5, 0.8)).normalize();
        let initial = BodyState { axis: n, momentum, equatorial_axis };
        let mean = AveragedSolution::new(&body, &coefficients, &initial, AveragingOrder::Second)?;
        let (x, rate) = (mean.relative_strength(), momentum.norm() / body.inertia_xx);
        let end = 3.0 / (x * rate);
        let exact = propagate(&body, &coefficients.tensor(), &initial, (0.0, end), 1e-13)?;
        for i in 0..=20 {
            let t = (end * f64::from(i) / 20.0).min(end);
            let off = difference(&mean.state(t), &exact.state(t)?);
            let allowed = x * x * (1.0 + x * rate * t);
            worst.see(off / allowed, || {
                format!("case {case} of seed 59 at t = {t}: s = {s:?}, n = {n:?}, L = {momentum:?}")
            });
        }
    }
    if followed < 25 {
        return Err(format!("only {followed} of 40 motions are away from the separatrix"));
    }
    worst.finish()
}

/// Errors of both orders by `k`: the largest of the tenths that the reference has.
fn errors_of_reference() -> Result<Vec<(f64, [f64; 2])>, String> {
    let scene = reference_motion("tp-2");
    let initial = scene.initial();
    let mut errors: Vec<(f64, [f64; 2])> = Vec::new();
    for line in include_str!("../../../data/mean_reference.csv").lines().filter(|line| !line.starts_with(['#', 'k'])) {
        let numbers: Vec<f64> =
            line.split(',').map(|cell| cell.parse().map_err(|_| line.to_owned())).collect::<Result<_, _>>()?;
        let [k, t] = [numbers[0], numbers[1]];
        let vector = |place: usize| Vector3::from_column_slice(&numbers[place..place + 3]);
        let exact = BodyState { axis: vector(2), momentum: vector(5), equatorial_axis: vector(8) };
        let values = [scene.coefficients.xx, scene.coefficients.yy, scene.coefficients.zz].map(|value| value * k);
        if errors.last().is_none_or(|(last, _)| *last != k) {
            errors.push((k, [0.0; 2]));
        }
        let (_, most) = errors.last_mut().ok_or("no k")?;
        for (order, most) in [AveragingOrder::First, AveragingOrder::Second].into_iter().zip(most) {
            let mean = AveragedSolution::new(&scene.spheroid, &PrincipalCoefficients::new(values), &initial, order)?;
            *most = largest([*most, difference(&mean.state(t), &exact)]);
        }
    }
    Ok(errors)
}

fn first_order_of_reference() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for (k, [first, second]) in errors_of_reference()? {
        worst.see(first / k, || format!("k = {k:e}: {first:.2e}, second order {second:.2e}"));
    }
    worst.finish()
}

fn slopes_of_reference() -> Result<Measured, String> {
    let errors: Vec<_> = errors_of_reference()?.into_iter().filter(|(k, _)| *k > 5e-6).collect();
    let mut worst = Worst::default();
    for (place, expected) in [(0, 1.0), (1, 2.0)] {
        let points: Vec<_> = errors.iter().map(|(k, errors)| (k.log10(), errors[place].log10())).collect();
        let fit = slope(&points)?;
        worst.see((fit.value - expected).abs(), || format!("order {expected}: {:.4} +- {:.4}", fit.value, fit.error));
    }
    worst.finish()
}

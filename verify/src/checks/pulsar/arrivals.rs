//! Times of arrival and residuals. Eqs. (44), (48), (51).

use super::cases::{Case, upright_star, worst_over_random_cases};
use crate::prelude::*;

checks! {
    /// there is an arrival for each whole pulse, inside it, and m.n is largest there
    Property "arrival-closest-approach" [44]: highest_in_pulse;
    AtMost(16.0) "largest excess of m.n at 100 times of a pulse over that at the closest approach / 2.2e-16, 600 random trains";
    because "m.n of two times is rounded some ten times each; the maximum is flat";
    /// a star that does not precess, spinning either way about any direction, has a pulse each turn, its period, and no residuals
    Oracle "arrival-steady-rotation" [44, 51]: steady_rotation;
    AtMost(8.0) "largest error of period x number or residual / (2.2e-16 (8 + phase) times the sensitivity of the edge), 200 stars over 100 t_c";
    because "the spin that follows from n and L in a turned frame is off by some ulp, and the phase by that times 200 rad";
    /// for free precession in any frame, alpha' = 13 |gamma'|, times of arrival repeat after 2 pi / |gamma'|, 13 turns later for chi < beta and 12
    /// for chi > beta, where the path of m leaves L outside of one turn; residuals have that period and are not zero
    Oracle "arrival-free-precession" [48, 51]: free_precession;
    AtMost(1e-12) "largest error of a repetition [t_c]; infinite if residuals stay below 1e-3 t_c or a number is wrong";
    because "phases up to 400 rad, and a motion with errors below 1e-12";
    /// residuals are time - epoch - period number, and normal to a constant and to the number: the least squares with weights
    Property "constant-period-fit" [51]: least_squares;
    AtMost(4.0) "largest error / (2.2e-16 times the sum of magnitudes), 200 random sets of 50 points with numbers up to 1e6";
    because "sums of 50 terms, each rounded a few times, independently of the others";
}

fn highest_in_pulse() -> Result<Measured, String> {
    worst_over_random_cases(81, 300, (20.0, 1e-14), |case| {
        let train = case.train()?;
        let whole: Vec<_> = train.pulses.iter().filter(|pulse| pulse.is_whole()).collect();
        let found = case.arrivals()?;
        if found.len() != whole.len() {
            return Ok(Some(f64::INFINITY));
        }
        largest_if_any(found.iter().zip(whole).map(|(arrival, pulse)| {
            let inside = pulse.start < arrival.closest_approach && arrival.closest_approach < pulse.end;
            let highest = case.margin(arrival.closest_approach)[0];
            let at = |i: u32| pulse.start + pulse.duration() * f64::from(i) / 100.0;
            let excess = (0..=100).map(|i| case.margin(at(i))[0] - highest);
            let excess = largest(excess.map(|x| if x <= 0.0 { 0.0 } else { x }));
            Ok(if inside { excess / f64::EPSILON } else { f64::INFINITY })
        }))
    })
}

/// The two times of an arrival.
const TIMES: [fn(&Arrival) -> f64; 2] = [|arrival| arrival.midpoint, |arrival| arrival.closest_approach];

fn numbered(found: &[Arrival], time: fn(&Arrival) -> f64) -> Vec<(i64, f64)> {
    found.iter().map(|arrival| (arrival.number, time(arrival))).collect()
}

/// Arrivals up to the time `end`, for a star and an observer that are rotated together.
fn arrivals_in_any_frame(
    random: &mut Random,
    problem: &Problem<f64>,
    end: f64,
    [chi, rho, theta_o]: [f64; 3],
) -> Result<Vec<Arrival>, String> {
    let frame = any_frame(random);
    let motion = problem.rotated(&frame).taylor((0.0, end), 1e-15)?;
    let observer = Observer::at(theta_o, random.within(-PI, PI)).rotated(&frame).direction;
    Case { name: String::new(), motion, beam: Beam::new(chi, random.within(-PI, PI), rho), observer }.arrivals()
}

/// A random rotation.
fn any_frame(random: &mut Random) -> Matrix3<f64> {
    let (alpha, beta, gamma) = (random.within(-PI, PI), random.within(0.1, 3.0), random.within(-PI, PI));
    body_from_inertial(&EulerAngles { alpha, beta, gamma })
}

fn steady_rotation() -> Result<Measured, String> {
    let (mut random, mut worst, mut stars) = (Random::with_seed(82), Worst::default(), 0);
    while stars < 200 {
        let [chi, theta_o] = [0; 2].map(|_| random.within(0.1, PI - 0.1));
        let (rho, spin) = (random.within(0.1, 2.0), random.within(0.4, 2.0));
        let PulseWidth::Pulsed(width) = pulse_width(rho, chi, theta_o) else { continue };
        stars += 1;
        let spin = if stars % 2 == 0 { spin } else { -spin };
        let star = upright_star(random.within(0.5, 1.8), spin)?;
        let found = arrivals_in_any_frame(&mut random, &star, 100.0, [chi, rho, theta_o])?;
        // Change of m.n per radian at an edge, and of its rate per radian at the maximum.
        let across = chi.sin() * theta_o.sin();
        let rounding = |t: f64, slope: f64| f64::EPSILON * (8.0 + spin.abs() * t) * (1.0 + 1.0 / slope) / spin.abs();
        let numbers_in_order = found.iter().enumerate().all(|(i, arrival)| arrival.number == i as i64);
        let mut figure: f64 = if numbers_in_order && found.len() > 4 { 0.0 } else { f64::INFINITY };
        for (slope, time) in [across * (width / 2.0).sin(), across].into_iter().zip(TIMES) {
            let fit = ConstantPeriod::fit(&numbered(&found, time), None)?;
            let scale = rounding(100.0, slope);
            let period = (fit.period - TAU / spin.abs()).abs() * found.len() as f64;
            figure = largest([figure, period / scale, largest(fit.residuals.iter().map(|r| r.abs() / scale))]);
        }
        worst.see(figure, || format!("star {stars} of seed 82: chi = {chi}, theta_o = {theta_o}, rho = {rho}, {spin}"));
    }
    worst.finish()
}

fn free_precession() -> Result<Measured, String> {
    let mut random = Random::with_seed(83);
    // alpha' / |gamma'| = (1 + epsilon) / (epsilon cos beta).
    let (oblateness, ratio) = (0.1, 13);
    let beta = ((1.0 + oblateness) / (oblateness * f64::from(ratio))).acos();
    let spheroid = RigidSpheroid::in_units_of_tc(1.0 + oblateness);
    let angles = EulerAngles { alpha: 0.0, beta, gamma: 0.0 };
    let rates = EulerRates { alpha: (1.0 + oblateness) / beta.cos(), beta: 0.0, gamma: -oblateness };
    let star = Problem::from_angles(spheroid, Matrix3::zeros(), &angles, &rates)?;
    let repetition = TAU / oblateness;
    let cases = [(0.4, ratio), (0.5, ratio), (0.7, ratio - 1), (1.2, ratio - 1)].into_iter();
    let cases = cases.flat_map(|(chi, turns)| [0.4, 0.7, 1.0].map(|theta_o| (chi, turns, theta_o)));
    worst_of(cases, |&(chi, turns, theta_o)| {
        let found = arrivals_in_any_frame(&mut random, &star, 4.2 * repetition, [chi, 0.5, theta_o])?;
        largest_of(TIMES.map(|time| {
            let later = |a: &Arrival| found.iter().find(|b| b.number == a.number + i64::from(turns)).map(time);
            let errors = found.iter().filter_map(|a| later(a).map(|t| (t - time(a) - repetition).abs()));
            let errors: Vec<f64> = errors.collect();
            let fit = ConstantPeriod::fit(&numbered(&found, time), None)?;
            let modulation = largest(fit.residuals.iter().map(|r| r.abs()));
            // The pulses of the first three of the four periods repeat, at least four in each.
            Ok(if errors.len() >= 12 && modulation > 1e-3 { largest(errors) } else { f64::INFINITY })
        }))
    })
}

fn least_squares() -> Result<Measured, String> {
    worst_of_draws(85, 200, |random| {
        let (first, period) = (random.within(-1e6, 1e6).round() as i64, random.within(0.1, 10.0));
        let mut number = first;
        let points: Vec<(i64, f64)> = (0..50)
            .map(|_| {
                number += random.within(0.0, 4.0) as i64;
                (number, 1e3 + period * number as f64 + random.within(-0.3, 0.3))
            })
            .collect();
        let weights: Vec<f64> = points.iter().map(|_| random.within(0.0, 2.0)).collect();
        let fit = ConstantPeriod::fit(&points, Some(&weights))?;
        let mut figure = 0.0;
        let (mut sums, mut sizes) = ([0.0; 2], [0.0; 2]);
        for ((&(number, time), weight), residual) in points.iter().zip(&weights).zip(&fit.residuals) {
            let (predicted, offset) = (fit.period * number as f64, (number - first) as f64);
            // The residuals are rounded as much as the times.
            for (k, (factor, size)) in [(1.0, 1.0), (offset, 100.0)].into_iter().enumerate() {
                sums[k] += weight * residual * factor;
                sizes[k] += weight * (residual.abs() + time.abs() / 50.0) * size;
            }
            let size = time.abs() + predicted.abs() + fit.epoch.abs();
            figure = largest([figure, (time - fit.epoch - predicted - residual).abs() / (f64::EPSILON * size)]);
        }
        let normal = largest([0, 1].map(|k| sums[k].abs() / (f64::EPSILON * sizes[k])));
        let halved: Vec<f64> = weights.iter().map(|w| w / 2.0).collect();
        let same = ConstantPeriod::fit(&points, Some(&halved))? == fit;
        let refused = ConstantPeriod::fit(&points[..1], None).is_err()
            && ConstantPeriod::fit(&[], None).is_err()
            && ConstantPeriod::fit(&points, Some(&weights[1..])).is_err()
            && ConstantPeriod::fit(&points, Some(&vec![0.0; 50])).is_err()
            && ConstantPeriod::fit(&[(0, 1.0), (1, f64::NAN)], None).is_err();
        Ok(if same && refused { largest([figure, normal]) } else { f64::INFINITY })
    })
}

//! Constraints on `s` from additional solitary pulsars: a forecast from their Fisher matrix. Eqs. (41), (42).

use twofold::observables::bound::fluid_inertia_over_c;
use twofold::observables::eta::secular_axis_rate;
use twofold::units::DEGREE;

use crate::averaged_scenes::direction;
use crate::prelude::*;
use twofold_scene::pulsar_table::{self, published::published};

checks! {
    /// three more solitary pulsars, five for five coefficients, measured as well as the two known ones and in random directions, would make today's
    /// limit on each spatial coefficient 3 to 5 orders of magnitude stronger; the published expectation is three to four from more of them
    /// (arXiv:2311.11038)
    Oracle "bounds-five-solitary-pulsars" [41, 42]: five;
    Within(3.0, 5.0) "median of 200 draws of the least log10(published limit / forecast one) of five coefficients, seed 61; infinite if that of the largest is above 5";
    because "rates of spin axes determine a combination of s to some 4e-16, today's limits are some 1e-11: 4.4 orders, less what directions nearly alike take away";
    /// two more, four for five coefficients, leave some coefficient nearly as poorly known as today
    Oracle "bounds-four-solitary-pulsars" [41, 42]: four;
    AtMost(0.35) "median of 200 draws of the least log10(published limit / forecast one) of five coefficients, seed 61";
    because "one combination of the five stays as it is known today, and some coefficient has at least 1 / sqrt(5) of it: log10(sqrt(5)) = 0.35";
}

/// The five spatial coefficients with unit tensors: traceless, as the trace exerts no torque.
fn coefficients() -> [(&'static str, Matrix3<f64>); 5] {
    let off = |i: usize, j: usize| Matrix3::from_fn(|a, b| f64::from(u8::from((a, b) == (i, j) || (a, b) == (j, i))));
    let diagonal = |x: f64, y: f64, z: f64| Matrix3::from_diagonal(&Vector3::new(x, y, z));
    [
        ("s^XX + s^YY - 2 s^ZZ", diagonal(1.0, 1.0, -2.0) / 6.0),
        ("s^XX - s^YY", diagonal(0.5, -0.5, 0.0)),
        ("s^XY", off(0, 1)),
        ("s^XZ", off(0, 2)),
        ("s^YZ", off(1, 2)),
    ]
}

/// Medians of the least and the largest improvement (orders of magnitude) of the limits on the five coefficients by `more` pulsars besides the two.
fn orders(more: usize) -> Result<[f64; 2], String> {
    const DRAWS: usize = 200;
    let coefficients = coefficients();
    let today = coefficients.map(|(quantity, _)| {
        let of_pulsars = published().find(|p| p.quantity == quantity && p.source.contains("2311.11038"));
        of_pulsars.expect("a published limit").limit
    });
    let pulses = pulsar_table::paper();
    let mut random = Random::with_seed(61);
    let (mut least, mut most) = (Vec::new(), Vec::new());
    for _ in 0..DRAWS {
        let mut fisher = DMatrix::from_diagonal(&DVector::from_iterator(5, today.iter().map(|limit| limit.powi(-2))));
        for k in 0..2 + more {
            // Pulsars alternately like PSR J1744-1134 and the interpulse of PSR B1937+21.
            let pulse = &pulses[1 + k % 2];
            // In units of the spin. The figure is 4 sin(lambda) |lambda'| / Omega.
            let (lambda, figure) = (pulse.lambda.value * DEGREE, pulse.figure("bound_over_eta_own")?);
            let error = figure.from_change.ok_or("no error")? / (4.0 * lambda.sin());
            let axis = direction(&mut random);
            let across = axis.cross(&direction(&mut random)).normalize();
            // The line of sight at the angle lambda to the axis, and the rate of lambda for each unit tensor.
            let sight = axis * lambda.cos() + across * lambda.sin();
            let slopes = coefficients.map(|(_, tensor)| -> f64 {
                let rate = secular_axis_rate(fluid_inertia_over_c(1.0), 1.0, &tensor, &axis);
                -rate.dot(&sight) / lambda.sin() / error
            });
            let slopes = DVector::from_row_slice(&slopes);
            fisher += &slopes * slopes.transpose();
        }
        // In units of today's limits the entries of the matrix have similar sizes.
        let scale = DMatrix::from_diagonal(&DVector::from_row_slice(&today));
        let covariance = (&scale * fisher * &scale).try_inverse().ok_or("a singular matrix")?;
        let orders: Vec<f64> = (0..5).map(|i| -0.5 * covariance[(i, i)].log10()).collect();
        least.push(smallest(orders.iter().copied()));
        most.push(largest(orders.iter().copied()));
    }
    Ok([least, most].map(|mut orders| {
        orders.sort_by(f64::total_cmp);
        orders[DRAWS / 2]
    }))
}

fn five() -> Result<Measured, String> {
    let found = [0, 1, 2, 3, 4, 8, 18].map(|more| Ok(format!("{} pulsars: {:.2?}", more + 2, orders(more)?)));
    let found = found.into_iter().collect::<Result<Vec<_>, String>>()?;
    let [least, most] = orders(3)?;
    let figure = if most < 5.0 { least } else { f64::INFINITY };
    Ok(Measured::new(figure, format!("least and largest orders, medians: {}", found.join(", "))))
}

fn four() -> Result<Measured, String> {
    let [least, most] = orders(2)?;
    Ok(Measured::new(least, format!("that of the largest: {most:.2}")))
}

//! Constraints on the star from the period and width of its pulses: rank of the Fisher matrix. Eqs. (44), (51), (52), (56),
//! (57).

use std::f64::consts::SQRT_2;

use crate::derivation::first_order::fixed_constants;
use crate::prelude::*;
use twofold::inference::Jacobian;
use twofold_scene::measurements::parameters_of;

checks! {
    /// the rates (57) of alpha and gamma do not change along d eps : d a^(1) = cos beta_0 : Omega^z, and Omega^z = gamma' + alpha' cos beta_0
    rates_along_null_direction: Autodiff "rates-blind-to-oblateness" [31, 32, 57];
    /// P(t) and W(t) by the formulas leave exactly one combination of Omega^z, eps, a^(1), beta_0, chi, rho, theta_o and the phase of gamma
    /// undetermined
    Autodiff "fisher-rank-of-period-and-width" [51, 52, 56, 57]: rank_of_formulas;
    Within(1.0, 1.0) "singular values of the Jacobian below 1e-12 of the largest, tp-I, 200 times over three turns of gamma";
    because "rounding of the Jacobian is some 1e-15 times the square root of its 400 rows; the next singular value must be above 1e-6";
    /// the undetermined direction is eps against a^(1) alone, at d eps : d a^(1) = cos beta_0 : Omega^z; Omega^z itself follows from the rates,
    /// gamma' + alpha' cos beta_0
    Autodiff "fisher-null-direction" [51, 52, 56, 57]: null_direction;
    AtMost(1e-11) "relative deviation of d(2 s^ZZ - s^XX - s^YY) : d eps of the direction found from that one, tp-I; infinite if it is not the only \
     one or moves anything else";
    because "rounding of the Jacobian, 1e-15 times some 20, over its second smallest singular value, 6e-3: 3e-12";
    /// arrival times and widths of the pulses of the numerical motion determine all parameters, also eps and C s / I^xx, besides eleven more
    /// unknowns. The degeneracy is due to the perturbation formulas
    Autodiff "fisher-rank-of-exact-signal" [25, 44, 57]: rank_of_signal;
    AtLeast(3.0) "decimal logarithm of the smallest singular value of the scaled Jacobian by 13 unknowns / what rounding can make of zero, tp-I, 200 \
     t_c";
    because "above zero the smallest singular value is not zero; at three, its direction is known to three digits";
}

fn rates_along_null_direction<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (spin, beta_0) = (p.rates.gamma, p.angles.beta);
    let (_, cos) = beta_0.sin_cos();
    let RigidSpheroid { inertia_xx, inertia_zz, constant_c } = p.spheroid;
    let forced_rate = |inertia_zz: F, combination: F| constant_c * combination * cos / (inertia_zz * spin);
    // I^zz = (1 + eps) I^xx; the combination that increases a^(1) at the rate Omega^z while I^zz increases.
    let inertia_rate = inertia_xx * cos;
    let combination = p.s.combination();
    let combination_rate = spin * inertia_zz * spin / (constant_c * cos) + combination * inertia_rate / inertia_zz;
    let spheroid = RigidSpheroid {
        inertia_xx: F::fixed(inertia_xx),
        inertia_zz: F::first(inertia_zz, inertia_rate),
        constant_c: F::fixed(constant_c),
    };
    let s = PrincipalCoefficients {
        xx: F::fixed(p.s.xx),
        yy: F::fixed(p.s.yy),
        zz: F::first(p.s.zz, combination_rate / 2.0),
    };
    let constants = Constants { alpha_0: p.angles.alpha, beta_0, amplitude: F::zero(), phase: F::zero() };
    let constants = fixed_constants(&constants);
    let moved =
        Perturbation::new_unchecked(Form::Printed, Precession::Twofold, &spheroid, &s, F::fixed(spin), &constants);
    let gamma_rate = F::fixed(spin) - moved.rate * F::fixed(cos);
    // gamma' as printed in Eq. (57).
    let oblateness = inertia_zz / inertia_xx - F::one();
    let printed = cos * forced_rate(inertia_zz, combination) - oblateness * spin;
    vec![
        F::derivative(moved.rate),
        F::derivative(gamma_rate),
        F::derivative(moved.forced_rate) - spin,
        F::value(gamma_rate) - printed,
    ]
}

/// `beta` stands for `beta_0`, `gamma` for its phase; `a^(1)` follows from `2 s^ZZ - s^XX - s^YY`.
const UNKNOWNS: [Parameter; 8] = [
    Parameter::Spin,
    Parameter::Oblateness,
    Parameter::SAxial,
    Parameter::Beta,
    Parameter::Chi,
    Parameter::Rho,
    Parameter::ThetaO,
    Parameter::Gamma,
];

fn tp_1() -> Result<Parameters<f64>, String> {
    let scene = Scene::named("tp-1")?;
    parameters_of(&scene).map_err(String::from)
}

/// Parameters of tp-I with its constants in place of initial values.
fn constants() -> Result<Parameters<f64>, String> {
    let model = tp_1()?;
    Ok(Parameters { angles: EulerAngles { beta: 0.7, gamma: FRAC_PI_2, ..model.angles }, ..model })
}

/// Period by Eqs. (51), (52) and width by Eq. (56), with the rates (57), at 200 times over three turns of gamma.
fn formulas<S: Real>(model: &Parameters<S>) -> Result<Vec<S>, twofold::Error> {
    let (one, spheroid, s) = (S::one(), model.spheroid, model.coefficients);
    let s = PrincipalCoefficients { xx: s[(0, 0)], yy: s[(1, 1)], zz: s[(2, 2)] };
    let (beta_0, chi) = (model.angles.beta, model.chi);
    let rates = shifted_rates(&spheroid, &s, model.spin(), beta_0)?;
    let step = (TAU * 3.0 / 200.0 / rates.gamma.re()).abs();
    let mut signal = Vec::new();
    for k in 0..200 {
        let gamma = model.angles.gamma + rates.gamma * (step * f64::from(k));
        let offset_rate = azimuth_offset_rate(beta_0, gamma, rates.gamma, chi, S::zero());
        signal.push(approximate_period(rates.alpha, offset_rate));
        let cosine = cosine_of_colatitude(beta_0, gamma, chi, S::zero());
        let theta = (one - cosine * cosine).sqrt().atan2(cosine);
        // The width of a grazing pulse has an infinite derivative.
        match pulse_width(model.rho, theta, model.theta_o) {
            PulseWidth::Pulsed(width) if width.re() > 0.1 => signal.push(width),
            _ => {}
        }
    }
    Ok(signal)
}

/// The Fisher matrix of the formulas, with one dual number per unknown.
fn fisher_of_formulas() -> Result<Fisher, String> {
    let model = constants()?;
    let column = |unknown: &Parameter| {
        let derivatives: Vec<f64> = formulas(&model.seeded(*unknown))?.iter().map(|value| value.eps).collect();
        Ok(DVector::from_vec(derivatives))
    };
    let columns = UNKNOWNS.iter().map(column).collect::<Result<Vec<_>, String>>()?;
    let matrix = DMatrix::from_columns(&columns);
    let jacobian =
        Jacobian { magnitudes: matrix.abs(), rounding: DVector::zeros(matrix.nrows()), matrix, relative_error: 1e-13 };
    Ok(Fisher::of_jacobian(&jacobian, &UNKNOWNS, &model))
}

fn rank_of_formulas() -> Result<Measured, String> {
    let values = fisher_of_formulas()?.singular_values;
    let detail = format!("singular values {}", listed(&values));
    let second_smallest = values[values.len() - 2] / values[0];
    if second_smallest.is_nan() || second_smallest < 1e-6 {
        return Err(format!("no clear rank: {detail}"));
    }
    let zero = values.iter().filter(|value| **value < 1e-12 * values[0]).count();
    Ok(Measured::new(zero as f64, detail))
}

fn null_direction() -> Result<Measured, String> {
    let found = fisher_of_formulas()?.degenerate;
    let [direction] = &found[..] else { return Err(format!("{} directions", found.len())) };
    let change =
        |wanted: Parameter| direction.change.iter().find(|(unknown, _)| *unknown == wanted).map(|(_, size)| *size);
    let (Some(oblateness), Some(combination), 2) =
        (change(Parameter::Oblateness), change(Parameter::SAxial), direction.change.len())
    else {
        return Err(direction.to_string());
    };
    // a^(1) = C (2 s^ZZ - s^XX - s^YY) cos beta_0 / (I^zz Omega^z), with d eps : d a^(1) = cos beta_0 : Omega^z.
    let (inertia_zz, cos) = (1.1, 0.7_f64.cos());
    let forced_rate = COEFFICIENTS.combination() * cos / (inertia_zz * SPIN);
    let expected = COEFFICIENTS.combination() * (SPIN / cos / forced_rate + 1.0 / inertia_zz);
    Ok(Measured::new(largest([(combination / oblateness / expected - 1.0).abs()]), direction.to_string()))
}

fn rank_of_signal() -> Result<Measured, String> {
    let (model, end) = (tp_1()?, 200.0);
    let signal = Signal::new(&model, end)?;
    let events = signal.events()?;
    // Independent edges known to 1e-3 t_c.
    let noise = [(Observable::Arrivals, 1e-3 / SQRT_2), (Observable::Widths, 1e-3 * SQRT_2)];
    let data = data_of(&signal, &events, &[], &noise)?;
    let fisher = Fisher::of(&model, &events, &data, &Parameter::OF_PULSES)?;
    let smallest = fisher.singular_values.last().ok_or("no singular values")?;
    let percent = |unknown| fisher.sigma(unknown).unwrap_or(f64::NAN) / f64::abs(unknown.value(&model)) * 100.0;
    Ok(Measured::new(
        (smallest / fisher.rounding).log10(),
        format!(
            "{} pulses; singular values {}; edges known to 1e-3 t_c give eps to {:.1} %, 2 s^ZZ - s^XX - s^YY to {:.1} %",
            events.len(),
            listed(&fisher.singular_values),
            percent(Parameter::Oblateness),
            percent(Parameter::SAxial)
        ),
    ))
}

fn listed(values: &[f64]) -> String {
    values.iter().map(|value| format!("{value:.1e}")).collect::<Vec<_>>().join(", ")
}

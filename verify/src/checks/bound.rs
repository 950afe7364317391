//! Bounds from the spin axis and from the pulse width. Eqs. (40)-(42), and (5).

use twofold::observables::bound::{lambda_change_terms, preferred_frame_bound};

use crate::prelude::*;
use twofold_scene::pulsar_table::published::{PrintedBounds, printed_bounds};
use twofold_scene::pulsar_table::{Pulsar, ROUND_INERTIA_OVER_C};

checks! {
    /// cos rho = cos chi cos zeta + sin chi sin zeta cos(W/2) stays constant along Delta zeta, and along Eq. (42) as printed with lambda = pi -
    /// zeta
    pulse_width_change: Autodiff "pulse-width-change" [42];
    /// for A = 0 and s^XX = s^YY, the estimate (40) of the change (38), (39) is |2 s^ZZ - s^XX - s^YY| times the factor sin t sin b cos(a - p) that
    /// the paper takes to be one
    Property "bound-estimate" [31, 38, 39, 40, 41]: estimate_of_known_change;
    AtMost(32.0) "largest relative difference / 2.2e-16, 200 random points";
    because "some ten products on each side, and cos(a - p), kept above 0.1, from two terms that may cancel to a tenth";
    /// a tensor of the form (5) has the combination -2 alpha_2 |w|^2 with Z along w: a bound equal to it gives |alpha_2|
    Property "preferred-frame-bound" [5, 40, 41]: bound_of_known_tensor;
    AtMost(16.0) "largest relative difference / 2.2e-16, 200 random alpha_2 and w";
    because "the eigenvalues are right to a few ulp of the largest one, which counts once or, as -w^2, twice";
    /// Eq. (42) gives the changes of lambda printed for the two pulsars
    Oracle "pulsar-angle-changes" [42]: printed_changes;
    AtMost(0.5) "largest difference / unit of the last printed digit";
    because "rounding of the printed numbers";
    /// (a) with the I^zz/C that the paper states, Eq. (41) gives larger bounds for the two pulsars than are printed
    Oracle "pulsar-bounds-stated-inertia" [41, 42, 43]: stated_inertia;
    AtLeast(2.0) "smallest ratio of the bound by Eq. (41), with the printed I^zz/C = 1e-5 s^2, to the printed one";
    because "a power of ten between half and twice our number would be a fair rounding";
    /// (b) with each star's own deformation, I^zz/C = 4/Omega^2, the bounds printed for both pulses of PSR B1937+21 are conservative, and that for
    /// PSR J1744-1134 is too strong by less than a factor of two
    Oracle "pulsar-bounds-own-deformation" [18, 41, 42]: own_deformation;
    Within(1.0, 2.0) "ratio of the bound by Eq. (41) to the printed one, PSR J1744-1134; infinite if that of a pulse of PSR B1937+21 is above one";
    because "above one the printed bound is stronger than ours; a power of ten within a factor of two is a fair rounding";
}

fn pulse_width_change<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (angle, chi, width) = (p.angles.beta, p.frame.beta, p.angles.alpha);
    let moved = |[change, width_change]: [F; 2]| (F::first(angle, change), F::first(width, width_change));
    let fixed_chi = F::fixed(chi);

    let (zeta, moved_width) = moved(zeta_change_terms(angle, chi, width));
    let opening = cos_opening_angle(zeta, fixed_chi, moved_width);

    let [numerator, denominator] = lambda_change_terms(angle, chi, width);
    let (lambda, moved_width) = moved([numerator, denominator]);
    // cos(pi - lambda) = -cos lambda: the first term changes sign.
    let with_reversed_cosine =
        cos_opening_angle(lambda, fixed_chi, moved_width) - lambda.sin_cos().1 * fixed_chi.sin_cos().1 * 2.0;

    let ((sl, cl), (sc, cc)) = (angle.sin_cos(), chi.sin_cos());
    let (sin_half, cos_half) = (width / 2.0).sin_cos();
    let printed = sin_half / 2.0 / (cl / sl * cos_half + cc / sc);
    vec![F::derivative(opening), F::derivative(with_reversed_cosine), numerator - printed * denominator]
}

fn estimate_of_known_change() -> Result<Measured, String> {
    worst_of_draws(40, 200, |random| {
        loop {
            let p = Point::<f64>::draw(random);
            let s = PrincipalCoefficients { yy: p.s.xx, ..p.s };
            let (spin, interval, theta, phi) = (p.rates.gamma, p.numbers[2], p.frame.beta, p.frame.alpha);
            let constants = Constants { alpha_0: p.angles.alpha, beta_0: p.angles.beta, amplitude: 0.0, phase: 0.0 };
            let (sin_b, cos_b) = constants.beta_0.sin_cos();
            let factor = theta.sin() * sin_b * (constants.alpha_0 - phi).cos();
            if factor.abs() < 0.1 || cos_b.abs() < 0.1 {
                continue;
            }
            let RigidSpheroid { inertia_zz, constant_c, .. } = p.spheroid;
            let solution =
                Perturbation::new_unchecked(Form::Printed, Precession::Single, &p.spheroid, &s, spin, &constants);
            let changes = changes_from_start(&solution, interval);
            let drift = SpinAxisDrift {
                polar_inertia_over_c: inertia_zz / constant_c,
                spin,
                interval,
                cos_lambda_change: cos_lambda_change(theta, phi, (constants.alpha_0, constants.beta_0), changes),
            };
            let estimate = drift.combination_bound(eta_from_inclination(constants.beta_0)?)?;
            return Ok((estimate / (s.combination() * factor).abs() - 1.0).abs() / f64::EPSILON);
        }
    })
}

fn bound_of_known_tensor() -> Result<Measured, String> {
    worst_of_draws(41, 200, |random| {
        let alpha_2 = random.within(-1e-3, 1e-3);
        let w = Vector3::from_fn(|_, _| random.within(-1e-3, 1e-3));
        let s = principal_frame(&coefficients_from_preferred_frame(alpha_2, &w))?.coefficients;
        // The eigenvalue that differs is the first or the last. Its axis becomes Z.
        let about_w = if alpha_2 < 0.0 { s.permuted() } else { s };
        let bound = preferred_frame_bound(about_w.combination(), &w)?;
        Ok((bound / alpha_2.abs() - 1.0).abs() / f64::EPSILON)
    })
}

fn printed_changes() -> Result<Measured, String> {
    worst_of(printed_bounds(), |(pulsar, printed)| {
        let printed = printed.lambda_change;
        let unit = if printed.contains('.') { 0.1 } else { 1.0 };
        let value: f64 = printed.parse().map_err(|_| format!("{printed} is not a number"))?;
        Ok((pulsar.lambda_change()? * 1e3 - value).abs() / unit)
    })
}

/// Bounds by Eq. (41) over the printed ones, both over eta: main pulse and interpulse of PSR B1937+21, PSR J1744-1134.
fn over_printed(bound_over_eta: impl Fn(&Pulsar) -> Result<f64, String>) -> Result<Vec<f64>, String> {
    let ratio = |(pulsar, printed): (Pulsar, PrintedBounds)| {
        let value: f64 = printed.bound.parse().map_err(|_| format!("{} is not a number", printed.bound))?;
        Ok(bound_over_eta(&pulsar)? * 1e16 / value)
    };
    printed_bounds().into_iter().map(ratio).collect()
}

fn stated_inertia() -> Result<Measured, String> {
    let ratios = over_printed(|pulsar| pulsar.bound_over_eta(ROUND_INERTIA_OVER_C).map_err(String::from))?;
    Ok(Measured::new(smallest(ratios.iter().copied()), format!("main pulse, interpulse, J1744: {ratios:.2?}")))
}

fn own_deformation() -> Result<Measured, String> {
    let ratios = over_printed(|pulsar| Ok(pulsar.figure("bound_over_eta_own")?.value))?;
    let [main, interpulse, other] = ratios[..] else { return Err(format!("ratios {ratios:?}")) };
    let figure = if main < 1.0 && interpulse < 1.0 { other } else { f64::INFINITY };
    Ok(Measured::new(figure, format!("main pulse, interpulse, J1744: {ratios:.3?}")))
}

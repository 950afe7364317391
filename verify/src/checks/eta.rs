//! The factor eta of the bound, from the averaged motion of the spin axis. Eqs. (31), (32), (34), (37)-(41).

use std::f64::consts::{FRAC_2_PI, FRAC_PI_4};
use std::num::NonZeroUsize;

use gauss_quad::GaussLegendre;
use twofold::observables::eta::{
    mean_squared_speed, root_mean_square_eta, single_precession_start, squared_speed, squared_speed_along_motion,
};

use crate::eta::{PAPER_ASYMMETRY, eta_curve, numerical_axis_rate, seen_rate, twelve_turns};
use crate::prelude::*;

/// Number of samples of a distribution.
const SAMPLES: usize = 20_000;

/// `x` at which `P(eta > x)` is compared with its integral.
const MULTIPLES: [f64; 7] = [2.1, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0];

/// Shapes of the tensor: symmetric about Z, the paper's, the most asymmetric one.
const SHAPES: [f64; 3] = [0.0, PAPER_ASYMMETRY, -1.0 / 3.0];

checks! {
    /// the secular rate of the spin axis is torque over angular momentum, is a^(1) about Z for s^XX = s^YY, and has the square of Eq. (41) with eta
    /// = 1 / speed
    torque_over_momentum: Property "secular-axis-rate" [31, 32, 41];
    /// the initial angles as functions of the asymmetry ratio alone are those of Eq. (34), lower signs, with A = 0
    start_by_asymmetry_ratio: Property "single-precession-start" [34];
    /// the closed mean of the squared speed of the spin axis over its azimuth is the mean over eight azimuths
    Property "eta-azimuth-mean" [41]: azimuth_mean;
    AtMost(16.0) "largest relative difference / 2.2e-16, 300 random inclinations and asymmetry ratios";
    because "the speed squared has azimuthal orders 0, 2 and 4, for which eight equal steps are exact; some ten roundings on each side";
    /// the mean of the squared speed along the secular motion, by elliptic integrals, is that of an integration in time over a period
    Oracle "eta-along-motion" [41]: along_motion;
    AtMost(1e-9) "largest relative difference, and distance from the start after the period, 60 random motions on both sides of the separatrix";
    because "Runge-Kutta of order four with 4000 steps a period: (2 pi / 4000)^4 / 120 a radian, times the harmonics of a motion near the separatrix";
    /// eta over random directions to the observer and random azimuths of the axis is distributed as the sum over speeds
    Oracle "eta-distribution" [37, 41]: distribution;
    AtMost(1.95) "largest Kolmogorov-Smirnov statistic sqrt(N) D, 20,000 samples each at four inclinations, seed 41";
    because "exceeded by chance in one case of a thousand";
    /// for a symmetric tensor and an unknown spin axis, P(eta > x) is the closed integral
    Oracle "eta-unknown-axis" [41]: unknown_axis;
    AtMost(3e-6) "largest relative difference for x = 2.1 to 1000";
    because "midpoint rule over a kink, beyond which 664 of the 16384 nodes lie at x = 1000: (1/664)^2 of the part beyond";
    /// eta over random orientations of the tensor's axes, at a known angle of the observer to the spin axis, is distributed as the sum over speeds
    Oracle "eta-at-known-angle" [37, 41]: known_angle;
    AtMost(1.95) "largest Kolmogorov-Smirnov statistic sqrt(N) D at 100 of 20,000 samples each, lambda = 30, 95 and 100 deg, three shapes of the \
     tensor, seed 42";
    because "exceeded by chance in one case of a thousand";
    /// for a symmetric tensor, P(eta > x) at a known angle is an integral over the inclination of Z to the third axis, normal to the spin axis and
    /// to the apparent motion
    Oracle "eta-at-known-angle-integral" [41]: known_angle_integral;
    AtMost(1e-5) "largest relative difference for x sin(lambda) = 2.1 to 1000";
    because "midpoint rule over a corner, beyond which 664 of the 16384 nodes lie at x = 1000: their number to the power of -3/2, over the part of \
     the probability that is next to it, some 1/10";
    /// of all shapes of the tensor the one symmetric about Z has the largest eta at 95 %, if its axes are unknown
    Property "eta-largest-for-symmetric-tensor" [41]: symmetric_is_largest;
    AtMost(1.0) "largest ratio to the eta at 95 % of r = 0, |r| = 0.01 to 3, line of sight at a right angle to the spin axis";
    because "asymmetry increases the speed where the axis would be slow, near the equator and the pole";
    /// for the paper's own tensor more than 5 % of directions and azimuths have an eta above 40, at every inclination
    Regime "eta-ten-exceeded" [41]: ten_exceeded;
    AtLeast(40.0) "smallest eta at 95 %, beta_0 = 0.05 to 1.57";
    because "the component of the velocity along a random direction is uniform up to the speed, sin b cos b for s^XX = s^YY, so that 5 % lie above 40 / sin 2b; \
     the asymmetry adds 2e-5 of it";
    /// the mean rate of the spin axis over twelve turns of the numerical motion is the secular one to first order in s
    Regime "eta-secular-rate" [40, 41]: secular_rate;
    Within(0.9, 1.1) "slope of log(relative difference) against log k, s of the examples scaled by k = 3e-2 to 1e-3";
    because "what is neglected is of second order in s, of first order relative to the rate; the curvature of the path adds (k 12 turns)^2/24";
    /// median, 84 % and 97.5 % of eta from numerical motions are those of the secular rate
    Regime "eta-by-numerical-motion" [40, 41]: by_numerical_motion;
    AtMost(0.01) "largest relative difference, beta_0 = 0.2 to 1.5, s of the examples scaled by 1e-3, 24 azimuths";
    because "first order in s, 1e-3 x (0.04 / 0.11), over the share of the fastest speed that the axis has near its slowest azimuths, 1/r = 11";
    /// for beta_0 from 0.2 to 1.1 the paper's 1 / cos beta_0 is eta to an order of magnitude, and always too small
    Regime "eta-estimate-order" [40, 41]: estimate_order;
    AtMost(1.0) "largest log10(eta cos beta_0), infinite if one is negative; root mean square over directions, azimuths and time or at the \
     inclination, three shapes of the tensor";
    because "an order of magnitude: a factor of ten";
    /// towards beta_0 = 0 eta grows as 1 / sin beta_0, where 1 / cos beta_0 goes to one: the estimate leaves out the factor sin beta of Eq. (38)
    Regime "eta-estimate-lacks-sine" [38, 39, 40, 41]:
        || order_of_error(&[1e-3, 1e-2, 1e-1], |beta| Ok(root_mean_square_along_motion(PAPER_ASYMMETRY, beta)));
    Within(-1.01, -0.99) "slope of log eta against log beta_0, 1e-3 to 1e-1, the paper's tensor";
    because "sqrt(3 / (1 + r^2)) / (sin b cos b): the next order shifts the slope by some b^2";
    /// another average gives another eta at pi/2: without later times, at that inclination, its root mean square value is sqrt(6) / |r|
    Regime "eta-depends-on-average" [41]: || {
        worst_of([PAPER_ASYMMETRY, 0.3, -1.7], |&ratio: &f64| {
            let eta: f64 = root_mean_square_eta(ratio, FRAC_PI_2)?;
            Ok((eta * ratio.abs() / 6.0_f64.sqrt() - 1.0).abs())
        })
    };
    AtMost(1e-14) "largest |eta |r| / sqrt(6) - 1| at pi/2, r of the paper's tensor, 0.3 and -1.7, root mean square over directions and azimuths";
    because "a few roundings, and cos^2 of pi/2 in doubles, 4e-33, over r^2";
    /// for the paper's tensor eta increases to 10 towards pi/2, as the paper says, if the changes of inclination along the motion are averaged over
    Regime "eta-near-right-angle" [41]: near_right_angle;
    Within(5.0, 20.0) "eta at pi/2, infinite if it does not increase from beta_0 = 1.1 on; root mean square over directions, azimuths and time";
    because "'10' read as within a factor of two";
    /// 10 is not an upper limit of eta: at beta_0 = pi/2 it grows without limit as the tensor becomes symmetric, as that of alpha_2 is
    Regime "eta-ten-is-no-maximum" [5, 41]:
        || order_of_error(&[1e-2, 1e-3, 1e-4], |ratio| Ok(root_mean_square_along_motion(-ratio, FRAC_PI_2)));
    Within(-0.51, -0.49) "slope of log eta(pi/2) against log |r|, r = 1e-2 to 1e-4";
    because "the axis swings up to cos beta ~ sqrt|r| and moves with that speed; the next order shifts the slope by about r";
}

fn torque_over_momentum<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let spin = p.rates.gamma;
    let axis = symmetry_axis(p.angles.alpha, p.angles.beta);
    let inertia_over_c = p.spheroid.inertia_zz / p.spheroid.constant_c;
    let rate = secular_axis_rate(inertia_over_c, spin, &p.s.tensor(), &axis);
    let momentum = p.spheroid.inertia_zz * spin;
    let (_, torque) = reduced_rates(&p.spheroid, &p.s.tensor(), &axis, &(axis * momentum));
    let from_torque = rate - torque / momentum;

    let symmetric = PrincipalCoefficients { yy: p.s.xx, ..p.s };
    let constants =
        Constants { alpha_0: p.angles.alpha, beta_0: p.angles.beta, amplitude: F::zero(), phase: F::zero() };
    let forced =
        Perturbation::new_unchecked(Form::Printed, Precession::Single, &p.spheroid, &symmetric, spin, &constants);
    let about_z = Vector3::new(F::zero(), F::zero(), forced.forced_rate).cross(&axis);
    let from_forced = secular_axis_rate(inertia_over_c, spin, &symmetric.tensor(), &axis) - about_z;

    let unit = p.s.combination() / (inertia_over_c * spin);
    let ratio = p.s.asymmetry() / p.s.combination();
    let square = rate.dot(&rate) - squared_speed(ratio, p.angles.alpha, p.angles.beta) * unit * unit;
    components![from_torque, from_forced, square]
}

fn start_by_asymmetry_ratio<F: Differentiable>(p: &Point<F>) -> Vec<F> {
    let (alpha_0, beta_0) = (p.angles.alpha, p.angles.beta);
    let ratio = p.s.asymmetry() / p.s.combination();
    let (alpha, beta) = single_precession_start(ratio, alpha_0, beta_0);
    let constants = Constants { alpha_0, beta_0, amplitude: F::zero(), phase: F::one() };
    let start =
        Perturbation::new_unchecked(Form::Printed, Precession::Single, &p.spheroid, &p.s, p.rates.gamma, &constants)
            .at(F::zero());
    vec![alpha - start.alpha, beta - start.beta]
}

fn azimuth_mean() -> Result<Measured, String> {
    worst_of_draws(31, 300, |random| {
        let (ratio, beta, alpha) = (random.within(-1.0, 1.0), random.within(0.0, PI), random.within(0.0, TAU));
        let mean = (0..8).map(|k| squared_speed(ratio, alpha + f64::from(k) * FRAC_PI_4, beta)).sum::<f64>() / 8.0;
        Ok((mean_squared_speed(ratio, beta) / mean - 1.0).abs() / f64::EPSILON)
    })
}

/// Eigenvalues of a tensor with the asymmetry ratio `r`, no trace and `2 s^ZZ - s^XX - s^YY = 1`.
fn of_shape(ratio: f64) -> [f64; 3] {
    [ratio / 2.0 - 1.0 / 6.0, -ratio / 2.0 - 1.0 / 6.0, 1.0 / 3.0]
}

/// Mean of `|dl/dt|^2` over the time `period` by Runge-Kutta, and the distance of the end from the start.
fn integrated_mean(s: &Matrix3<f64>, start: Vector3<f64>, period: f64) -> (f64, f64) {
    const STEPS: usize = 4000;
    let rate = |l: &Vector3<f64>| secular_axis_rate(1.0, 1.0, s, l);
    let step = period / STEPS as f64;
    let (mut l, mut sum) = (start, 0.0);
    for _ in 0..STEPS {
        let k1 = rate(&l);
        let k2 = rate(&(l + k1 * (step / 2.0)));
        let k3 = rate(&(l + k2 * (step / 2.0)));
        let k4 = rate(&(l + k3 * step));
        sum += k1.norm_squared();
        l += (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (step / 6.0);
    }
    (sum / STEPS as f64, (l - start).norm())
}

/// Period `4 K / (2 sqrt((s2 - s3)(s1 - h)))` of the secular motion for `I^zz / C = Omega^z = 1`, on either side of the separatrix.
fn secular_period(mut s: [f64; 3], h: f64) -> f64 {
    s.sort_by(|a, b| b.total_cmp(a));
    let [first, middle, last] = if h > s[1] { [s[2], s[1], s[0]] } else { s };
    let squared = (middle - last) * (first - h);
    4.0 * complete_integral((first - last) * (middle - h) / squared) / (2.0 * squared.sqrt())
}

fn along_motion() -> Result<Measured, String> {
    worst_of_draws(33, 60, |random| {
        let (ratio, alpha, beta) = (random.within(-1.0, 1.0), random.within(0.0, TAU), random.within(0.1, PI - 0.1));
        let s = of_shape(ratio);
        let (tensor, axis) = (PrincipalCoefficients::new(s).tensor(), symmetry_axis(alpha, beta));
        let period = secular_period(s, axis.dot(&(tensor * axis)));
        let (integrated, off) = integrated_mean(&tensor, axis, period);
        let closed = squared_speed_along_motion(ratio, alpha, beta);
        Ok(largest([(closed / integrated - 1.0).abs(), off]))
    })
}

fn distribution() -> Result<Measured, String> {
    let mut random = Random::with_seed(41);
    worst_of([0.3, 1.0, 1.4, 1.55], |&beta| {
        let eta = |_| {
            let axis = symmetry_axis(random.within(0.0, TAU), beta);
            let direction = symmetry_axis(random.within(0.0, TAU), random.within(-1.0, 1.0).acos());
            let rate = secular_axis_rate(1.0, 1.0, &COEFFICIENTS.tensor(), &axis);
            (COEFFICIENTS.combination() / direction.dot(&rate)).abs()
        };
        let samples = (0..SAMPLES).map(eta).collect();
        Ok(kolmogorov_smirnov(samples, &EtaDistribution::new(PAPER_ASYMMETRY, SpinAxis::AtInclination(beta))?, 1))
    })
}

fn known_angle() -> Result<Measured, String> {
    let mut random = Random::with_seed(42);
    worst_of(SHAPES, |&ratio| {
        let s = PrincipalCoefficients::new(of_shape(ratio)).tensor();
        let unknown = EtaDistribution::new(ratio, SpinAxis::Unknown)?;
        worst_of([30.0_f64, 95.0, 100.0], |degrees| {
            let lambda = degrees.to_radians();
            let samples = (0..SAMPLES).map(|_| 1.0 / seen_rate(&mut random, &s, lambda).abs()).collect();
            Ok(kolmogorov_smirnov(samples, &unknown.clone().seen_at(lambda)?, 200))
        })
    })
}

fn known_angle_integral() -> Result<Measured, String> {
    let rule = GaussLegendre::new(NonZeroUsize::new(80).ok_or("no nodes")?);
    let lambda = 1.745_f64;
    let distribution = EtaDistribution::new(0.0, SpinAxis::Unknown)?.seen_at(lambda)?;
    worst_of(MULTIPLES, |&scaled| {
        // n.dl/dt = sin(lambda) (Z.l)(Z.b) with b normal to l: half of (1 - mu^2) sin(2 phi) about the third axis, so that P = int_0^1 (2/pi) asin
        // min(1, 2 / (x (1 - mu^2))) d mu. The integrand is one beyond the kink, and a square root just below it.
        let kink = (1.0 - 2.0 / scaled).sqrt();
        let root = |t: f64| {
            let mu = kink * (1.0 - t * t);
            2.0 * kink * t * FRAC_2_PI * (2.0 / (scaled * (1.0 - mu * mu))).min(1.0).asin()
        };
        let integral = 1.0 - kink + rule.integrate(0.0, 1.0, root);
        Ok((distribution.probability_above(scaled / lambda.sin()) / integral - 1.0).abs())
    })
}

fn symmetric_is_largest() -> Result<Measured, String> {
    let of_shape = |ratio: f64| EtaDistribution::new(ratio, SpinAxis::Unknown)?.seen_at(FRAC_PI_2)?.quantile(0.95);
    let symmetric = of_shape(0.0)?;
    worst_of([0.01, 0.03, 1.0 / 11.0, 0.2, 1.0 / 3.0, 1.0, 3.0], |&ratio: &f64| Ok(of_shape(-ratio)? / symmetric))
}

fn ten_exceeded() -> Result<Measured, String> {
    let inclinations = (0..=152).map(|i| 0.05 + 0.01 * f64::from(i));
    let smallest = least_of(inclinations, |&beta| {
        Ok(EtaDistribution::new(PAPER_ASYMMETRY, SpinAxis::AtInclination(beta))?.quantile(0.95)?)
    })?;
    let share = EtaDistribution::new(PAPER_ASYMMETRY, SpinAxis::Unknown)?.probability_above(10.0);
    let detail = format!("{}; above 10 with probability {share:.2} if nothing is known of the axis", smallest.detail);
    Ok(Measured::new(smallest.figure, detail))
}

/// Kolmogorov-Smirnov statistic: largest distance between samples, one of `every`, and a distribution, times the root of their number.
fn kolmogorov_smirnov(mut samples: Vec<f64>, expected: &EtaDistribution, every: usize) -> f64 {
    samples.sort_by(f64::total_cmp);
    let n = samples.len() as f64;
    let distance = largest(samples.iter().enumerate().step_by(every).map(|(i, &eta)| {
        let below = 1.0 - expected.probability_above(eta);
        (below - i as f64 / n).abs().max(((i as f64 + 1.0) / n - below).abs())
    }));
    distance * n.sqrt()
}

fn unknown_axis() -> Result<Measured, String> {
    let distribution = EtaDistribution::new(0.0, SpinAxis::Unknown)?;
    worst_of(MULTIPLES, |&x| {
        // P = int_0^1 min(1, 1 / (x mu sqrt(1 - mu^2))) d mu; the integrand leaves 1 where mu^2 (1 - mu^2) = 1 / x^2.
        let root = (1.0 - 4.0 / (x * x)).sqrt();
        let (low, high) = ((2.0 / (x * x) / (1.0 + root)).sqrt(), ((1.0 + root) / 2.0).sqrt());
        let antiderivative = |mu: f64| -((1.0 + (1.0 - mu * mu).sqrt()) / mu).ln();
        let closed = low + (1.0 - high) + (antiderivative(high) - antiderivative(low)) / x;
        Ok((distribution.probability_above(x) / closed - 1.0).abs())
    })
}

fn secular_rate() -> Result<Measured, String> {
    order_of_error(&[3e-2, 1e-2, 3e-3, 1e-3], |k| {
        let s = COEFFICIENTS.scaled(k);
        let (rate, axis) = numerical_axis_rate(&s, SPIN, (0.4, 0.9), twelve_turns(SPIN))?;
        let secular = secular_axis_rate(1.1, SPIN, &s.tensor(), &axis);
        Ok((rate - secular).norm() / secular.norm())
    })
}

fn by_numerical_motion() -> Result<Measured, String> {
    let s = COEFFICIENTS.scaled(1e-3);
    let unit = s.combination().abs() / (1.1 * SPIN);
    worst_of([0.2, 0.7, 1.1, 1.3, 1.5], |&beta| {
        let (mut numerical, mut secular) = (Vec::new(), Vec::new());
        for alpha in (0..24).map(|i| FRAC_PI_2 * (f64::from(i) + 0.5) / 24.0) {
            let (rate, _) = numerical_axis_rate(&s, SPIN, (alpha, beta), twelve_turns(SPIN))?;
            numerical.push((rate.norm() / unit, 1.0));
            secular.push((squared_speed(PAPER_ASYMMETRY, alpha, beta).sqrt(), 1.0));
        }
        let (numerical, secular) = (EtaDistribution::from_speeds(numerical)?, EtaDistribution::from_speeds(secular)?);
        worst_of([0.5, 0.84, 0.975], |&probability| {
            Ok((numerical.quantile(probability)? / secular.quantile(probability)? - 1.0).abs())
        })
    })
}

fn estimate_order() -> Result<Measured, String> {
    let inclinations: Vec<f64> = (0..=90).map(|i| 0.2 + 0.01 * f64::from(i)).collect();
    worst_of(SHAPES, |&ratio| {
        worst_of(eta_curve(ratio, &inclinations)?, |point| {
            worst_of([point.along_motion, point.at_inclination.root_mean_square], |eta| {
                let excess = (eta / point.printed).log10();
                Ok(if excess < 0.0 { f64::INFINITY } else { excess })
            })
        })
    })
}

fn near_right_angle() -> Result<Measured, String> {
    let etas: Vec<f64> =
        (0..=47).map(|i| root_mean_square_along_motion(PAPER_ASYMMETRY, FRAC_PI_2 - 0.01 * f64::from(i))).collect();
    let increases = etas.windows(2).all(|pair| pair[0] > pair[1]);
    Ok(Measured::new(if increases { etas[0] } else { f64::INFINITY }, format!("{:.3} at 1.1 rad", etas[47])))
}

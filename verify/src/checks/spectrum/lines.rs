//! Lines of the paper's signals: compared with the numerical motion, with the lines of free precession, and with the slow
//! precession.

use nalgebra::Complex;

use super::super::averaged::orders::{late_states_of_tp_2, tp_2};
use super::signals::{LEAST, examples, lines_of_signals, rate, signals_of, strongest};
use crate::mean_rate::{azimuth_of_momentum, kaiser, mean_rate_of};
use crate::prelude::*;

/// Frequencies of the order of the coefficients for Lorentz violation [1/t_c].
const SLOW: std::ops::Range<f64> = 0.01..0.1;

checks! {
    /// m.n, h_+ and h_x of tp-I and tp-II are sums of lines at integer combinations of alpha', gamma' and the slow frequency: with all lines above 1e-12 of
    /// the strongest they are those of the numerical motion
    Oracle "lines-identified" [47, 71]: sums_of_lines;
    AtMost(1e-10) "largest difference from the numerical motion, 300 random times up to 1,000 t_c";
    because "two hundred lines of the next decade below 4e-13 are left out, and the numerical motion is right to 1e-11";
    /// amplitudes and phases of the twenty strongest lines of each are those of the Fourier integral over the numerical motion
    Oracle "lines-of-motion" [47, 71]: lines_by_fourier_integral;
    AtMost(5e-10) "largest difference of a complex amplitude, Kaiser window of shape 20 over 24,000 t_c";
    because "no two lines are nearer than 0.028 / t_c, where the window lets through 2.5e-10 of a line; the others are 2 in sum";
    /// m.n and h_+ of motions in random frames, with axes, sizes of L and coefficients drawn at random, are the sums of their lines
    Property "lines-random" [47, 71]: random_motions;
    AtMost(1e-9) "largest difference from the numerical motion, 40 motions, 5 times up to 200 t_c each; infinite if a line is not at the combination \
     that it is called, or the least amplitude is above 2e-11";
    because "up to a thousand lines below 1e-12 are left out";
    /// at late times the components of n and e_x along X are the sums of their lines, within the error that each line states for its frequency: tp-II
    /// with s scaled by 1e-4 to 1e-6, compared with states computed with 32 digits
    Oracle "line-uncertainties" [25, 57]: uncertainties;
    AtMost(1.0) "largest difference from the state / (sum over the lines of amplitude x stated error x t, and 1e-11), 3e5 to 1.5e7 t_c";
    because "frequencies are rounded once, by at most half of the stated error; the lines below 1e-12 that are left out add to less than 1e-11";
    /// in free precession m.n has exactly four lines, alpha', |gamma'| and alpha' +- gamma', with amplitudes in closed form, and h exactly two, alpha'
    /// and 2 alpha'
    Oracle "free-precession-lines" [47, 48, 68, 71]: free_precession;
    AtMost(1e-14) "largest error of a frequency, or of an amplitude of m.n; infinite if a line is missing or there is another one above 1e-12 of the strongest";
    because "rounding of frequencies up to 3, and of coefficients";
    /// m.n of tp-II has a line between 0.03 and 0.04 / t_c, and it is the mean rate of the azimuth of L about Z
    Oracle "slow-line-tp-2" [47, 57]: slow_line_of_tp_2;
    AtMost(1e-13) "|frequency of the strongest line there - |mean rate|| [1/t_c]; infinite if it is below a tenth of the highest line";
    because "the mean rate is a weighted average over 2,400 t_c, right to that (mean-rates-averages)";
    /// m.n of tp-I shows no such line: the azimuth of L has the mean rate of alpha, and the line at the slow frequency, 0.0280 / t_c, has less
    /// than a hundredth of the highest amplitude
    Oracle "slow-line-tp-1" [47, 57]: slow_line_of_tp_1;
    AtMost(0.01) "largest amplitude between 0.01 and 0.1 / that of the highest line; infinite unless L and alpha have one mean rate and the line is \
     that of the averaged L";
    because "a hundredth cannot be seen on the figure's linear axis";
    /// the waves of tp-I and tp-II show no line of the order of the coefficients
    Oracle "slow-line-waves" [57, 71]: slow_line_of_waves;
    AtMost(0.01) "largest amplitude between 0.01 and 0.1 / that of the highest line, h_+ and h_x";
    because "a hundredth cannot be seen on the figure's linear axis";
    /// the slow frequency of tp-II has the order of magnitude of the coefficients for Lorentz violation
    Oracle "slow-frequency-magnitude" [35, 57]: slow_magnitude;
    Within(10f64.powf(-0.5), 3.162_277_660_168_379_5) "|slow frequency| t_c / geometric mean of |s^XX|, |s^YY|, |s^ZZ|";
    because "half a decade on either side";
}

fn sum(list: &LineList, t: f64) -> f64 {
    list.constant + list.lines.iter().map(|line| line.value(t)).sum::<f64>()
}

fn uncertainties() -> Result<Measured, String> {
    let late: Vec<_> = late_states_of_tp_2()?.into_iter().filter(|(_, t, _)| *t > 2e5).collect();
    let mut scales: Vec<f64> = late.iter().map(|(k, ..)| *k).collect();
    scales.dedup();
    worst_of(scales, |&k| {
        let motion = QuasiPeriodicMotion::new(&tp_2(k)?)?;
        worst_of(0..2, |&vector| {
            let component = |state: &BodyState<f64>| [state.axis, state.equatorial_axis][vector].x;
            let list = motion.lines(LEAST, |state| Ok::<_, Error>([component(state), 1.0]))?;
            worst_of(late.iter().filter(|(of, ..)| *of == k), |(_, t, state)| {
                // The angle over the whole time, to 32 digits: its rounding would be as large as that of the frequency.
                let value = |line: &SpectralLine| {
                    let angle = DoubleDouble::from_f64(line.frequency) * *t + DoubleDouble::from_f64(line.phase);
                    line.amplitude * angle.sin_cos().1.high()
                };
                let sum = list.constant + list.lines.iter().map(value).sum::<f64>();
                let stated: f64 = list.lines.iter().map(|line| line.amplitude * line.uncertainty).sum();
                Ok((sum - component(state)).abs() / (stated * t + 1e-11))
            })
        })
    })
}

fn sums_of_lines() -> Result<Measured, String> {
    let mut random = Random::with_seed(20);
    worst_of(examples()?, |example| {
        let problem = reference_motion(example.scene).problem();
        let motion = problem.taylor((0.0, 1000.0), 1e-15)?;
        worst_of((0..300).map(|_| random.within(0.0, 1000.0)), |&t| {
            let signals = signals_of(&problem, &motion.state(t)?);
            let lists = example.signals().map(|(_, list)| list);
            Ok(largest(signals.iter().zip(lists).map(|(signal, list)| (signal - sum(list, t)).abs())))
        })
    })
}

fn lines_by_fourier_integral() -> Result<Measured, String> {
    const DURATION: f64 = 24_000.0;
    const COUNT: usize = 1 << 16;
    let weights = kaiser(COUNT, 20.0);
    let step = DURATION / COUNT as f64;
    worst_of(examples()?, |example| {
        let problem = reference_motion(example.scene).problem();
        let motion = problem.taylor((0.0, DURATION), 1e-15)?;
        let samples: Vec<_> = (0..COUNT).map(|j| (j as f64 + 0.5) * step).collect();
        let signals =
            samples.iter().map(|&t| Ok(signals_of(&problem, &motion.state(t)?))).collect::<Result<Vec<_>, Error>>()?;
        worst_of(example.signals().into_iter().enumerate(), |(signal, (name, list))| {
            worst_of(list.lines.iter().take(20), |line| {
                let mut integral = Complex::new(0.0, 0.0);
                for ((t, weight), values) in samples.iter().zip(&weights).zip(&signals) {
                    integral += Complex::from_polar(weight * (values[*signal] - list.constant), -line.frequency * t);
                }
                let found = integral * (2.0 / COUNT as f64);
                let off = (found - Complex::from_polar(line.amplitude, line.phase)).norm();
                Ok(Measured::new(off, format!("{name}, {}", line.combination)))
            })
        })
    })
}

fn random_motions() -> Result<Measured, String> {
    let mut symbols = std::collections::BTreeSet::new();
    let measured = worst_of_draws(21, 40, |random| {
        let mut vector = || Vector3::from_fn(|_, _| random.within(-1.0, 1.0));
        let (axis, direction, turn) = (vector().normalize(), vector().normalize(), vector() * 3.0);
        let across = axis.cross(&vector()).normalize();
        let frame = nalgebra::Rotation3::new(turn);
        let values = vector() * 0.03;
        let s = frame * Matrix3::from_diagonal(&values.add_scalar(-values.mean())) * frame.transpose();
        let spheroid = RigidSpheroid::in_units_of_tc(random.within(0.8, 1.3));
        let start = BodyState { axis, momentum: direction * random.within(0.9, 2.0), equatorial_axis: across };
        let problem = Problem::new(spheroid, s, start)?;
        let exact = QuasiPeriodicMotion::new(&problem)?;
        let motion = problem.taylor((0.0, 200.0), 1e-15)?;
        let lists = lines_of_signals(&problem, &exact)?;
        // The lists are complete down to a small amplitude.
        if lists.iter().any(|list| !(list.least < 2e-11 && list.left < 1e-9)) {
            return Ok(f64::INFINITY);
        }
        let basis = &exact.frequencies().basis;
        symbols.extend(basis.iter().map(|of| of.symbol));
        for line in &lists[0].lines {
            let terms = line.combination.terms.iter().zip(basis).map(|((k, _), of)| f64::from(*k) * of.rate);
            if (terms.sum::<f64>().abs() - line.frequency).abs() > 1e-13 {
                return Ok(f64::INFINITY);
            }
        }
        worst_of((0..5).map(|_| random.within(0.0, 200.0)), |&t| {
            let signals = signals_of(&problem, &motion.state(t)?);
            Ok(largest(signals.iter().zip(&lists).take(2).map(|(signal, list)| (signal - sum(list, t)).abs())))
        })
        .map(|measured| measured.figure)
    })?;
    Ok(Measured::new(measured.figure, format!("{}; named by {symbols:?}", measured.detail)))
}

fn free_precession() -> Result<Measured, String> {
    let spheroid = RigidSpheroid::in_units_of_tc(1.1);
    let free = free_precession_rates(&spheroid, 1.0, 0.7)?;
    let angles = EulerAngles { alpha: 0.4, beta: 0.7, gamma: 0.2 };
    let rates = EulerRates { alpha: free.alpha, beta: 0.0, gamma: free.gamma };
    let problem = Problem::from_angles(spheroid, Matrix3::zeros(), &angles, &rates)?;
    let lists = lines_of_signals(&problem, &QuasiPeriodicMotion::new(&problem)?)?;
    let (a, g) = (free.alpha, free.gamma.abs());
    // m.n = cos(theta_o) (sin chi sin beta sin gamma + cos chi cos beta)
    //       + sin(theta_o) Re e^(i alpha) [sin chi ((1 + cos beta) e^(i gamma) + (1 - cos beta) e^(-i gamma)) / 2 - i cos chi sin beta], gamma' < 0
    let ((sin_b, cos_b), (sin_chi, cos_chi), (sin_o, cos_o)) =
        (0.7_f64.sin_cos(), 0.5_f64.sin_cos(), 0.8_f64.sin_cos());
    let amplitudes = [
        cos_o * sin_chi * sin_b,
        sin_o * sin_chi * (1.0 + cos_b) / 2.0,
        sin_o * cos_chi * sin_b,
        sin_o * sin_chi * (1.0 - cos_b) / 2.0,
    ];
    let mut of_pulsar = lists[0].lines.clone();
    of_pulsar.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
    let off_amplitude = largest(of_pulsar.iter().zip(amplitudes).map(|(line, right)| (line.amplitude - right).abs()));
    let expected = [vec![g, a - g, a, a + g], vec![a, 2.0 * a], vec![a, 2.0 * a]];
    worst_of(lists.iter().zip(expected), |(list, expected)| {
        let mut found: Vec<f64> = list.lines.iter().map(|line| line.frequency).collect();
        found.sort_by(f64::total_cmp);
        if found.len() != expected.len() || list.least > LEAST {
            return Ok(Measured::new(f64::INFINITY, format!("lines {found:.9?}")));
        }
        let off = largest(found.iter().zip(expected).map(|(x, y)| (x - y).abs()));
        Ok(Measured::new(largest([off, off_amplitude]), format!("lines {found:.9?}")))
    })
}

/// Mean rate of the azimuth of `L` about Z in the numerical motion.
fn azimuth_rate_of(name: &str) -> Result<f64, String> {
    let motion = reference_motion(name).problem().taylor((0.0, 2400.0), 1e-13)?;
    Ok(mean_rate_of(&motion, 2400.0, 9600, azimuth_of_momentum)?)
}

fn slow_line_of_tp_2() -> Result<Measured, String> {
    let example = &examples()?[1];
    let line = strongest(&example.pulsar, 0.03..0.04)?;
    let rate = azimuth_rate_of("tp-2")?;
    let highest = example.pulsar.lines[0].amplitude;
    let figure = if line.amplitude > 0.1 * highest { (line.frequency - rate.abs()).abs() } else { f64::INFINITY };
    Ok(Measured::new(figure, format!("amplitude {:.3} of the highest", line.amplitude / highest)))
}

fn slow_line_of_tp_1() -> Result<Measured, String> {
    let example = &examples()?[0];
    let locked = (azimuth_rate_of("tp-1")? - example.rate("alpha'")?).abs() < 1e-11;
    let line = strongest(&example.pulsar, SLOW)?;
    let ratio = line.amplitude / example.pulsar.lines[0].amplitude;
    // The slow frequency is that of L averaged over the fast rotation.
    let there = (line.frequency - example.rate("l'")?.abs()).abs() < 1e-14;
    let figure = if locked && there { ratio } else { f64::INFINITY };
    Ok(Measured::new(
        figure,
        format!("{:.7}: {}, 1/{:.0} of the highest", line.frequency, line.combination, 1.0 / ratio),
    ))
}

fn slow_line_of_waves() -> Result<Measured, String> {
    worst_of(examples()?, |example| {
        Ok(largest(example.waves().map(|(_, list)| {
            // A list without a line there has none above its least amplitude.
            strongest(list, SLOW).map_or(list.least, |line| line.amplitude) / list.lines[0].amplitude
        })))
    })
}

fn slow_magnitude() -> Result<Measured, String> {
    let slow = rate(&examples()?[1].exact, "l'")?;
    let s = COEFFICIENTS;
    let mean = (s.xx * s.yy * s.zz).abs().cbrt();
    Ok(Measured::new(slow.abs() / mean, format!("slow frequency {slow:.8}, coefficients {} to {}", s.yy, s.zz.abs())))
}

//! Lines of the paper's signals: what they are, those of free precession, and the slow one.

use super::signals::{Example, beam, examples, line_of_sight, strongest, wave_of};
use crate::prelude::*;

/// Frequencies of the order of the coefficients for Lorentz violation [1/t_c].
const SLOW: std::ops::Range<f64> = 0.01..0.1;

checks! {
    /// every line of m.n above 1e-4 and of h_+ and h_x above 1e-6 of tp-I and tp-II is one combination of alpha', gamma' and the slow frequency
    Oracle "lines-identified" [47, 71]: all_identified;
    AtMost(0.0) "lines unidentified or ambiguous";
    because "the motion is quasi-periodic with these three frequencies";
    /// the frequencies of these lines, found in the series alone, are those combinations of the mean rates
    Oracle "lines-of-motion" [47, 71]: lines_against_rates;
    AtMost(1e-9) "largest difference, m.n above 1e-4, h above 1e-5 [1/t_c]";
    because "the documented error of a frequency of a line list";
    /// in free precession m.n has exactly four lines, alpha', |gamma'| and alpha' +- gamma', and h exactly two, alpha' and 2 alpha'
    Oracle "free-precession-lines" [47, 48, 68, 71]: free_precession;
    AtMost(1e-11) "largest amplitude in the spectrum of what these leave; infinite if one is missing or off by more than 1e-11";
    because "the motion and the products of its components are rounded at 1e-15, its phase at 3e-12 over the span";
    /// m.n of tp-II has a line between 0.03 and 0.04 / t_c, and it is the mean rate of the azimuth of L about Z
    Oracle "slow-line-tp-2" [47, 57]: slow_line_of_tp_2;
    AtMost(1e-9) "|frequency of the strongest line there - |mean rate|| [1/t_c]; infinite if it is below a tenth of the highest line";
    because "the documented error of a frequency of a line list";
    /// m.n of tp-I shows no such line: the azimuth of L counts turns of alpha, and the slow frequency, 0.0280 / t_c, is there all the same with
    /// less than a hundredth of the highest amplitude
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

fn each_line(
    least_wave: f64,
) -> Result<impl Iterator<Item = (&'static Example, &'static str, &'static SpectralLine)>, String> {
    let of = move |example: &'static Example| {
        example.signals().into_iter().flat_map(move |(signal, list)| {
            let wanted = move |line: &&SpectralLine| signal == "m.n" || line.amplitude >= least_wave;
            list.lines.iter().filter(wanted).map(move |line| (example, signal, line))
        })
    };
    Ok(examples()?.iter().flat_map(of))
}

fn all_identified() -> Result<Measured, String> {
    let (mut failed, mut total, mut detail) = (0, 0, String::new());
    for (example, signal, line) in each_line(0.0)? {
        total += 1;
        let what = example.basis.identify(line.frequency, line.uncertainty);
        if what.combination().is_none() {
            failed += 1;
            detail += &format!("; {} {signal} {:.9} ({:.1e}): {what}", example.name, line.frequency, line.amplitude);
        }
    }
    for example in examples()? {
        for (signal, list) in example.signals() {
            let least = if signal == "m.n" { 1e-4 } else { 1e-6 };
            if list.remainder > least {
                return Err(format!("{} {signal}: lines up to {:.1e} are left", example.name, list.remainder));
            }
        }
    }
    Ok(Measured::new(f64::from(failed), format!("of {total} lines{detail}")))
}

fn lines_against_rates() -> Result<Measured, String> {
    worst_of(each_line(1e-5)?, |(example, _, line)| {
        let what = example.basis.identify(line.frequency, line.uncertainty);
        Ok(what.combination().map_or(f64::INFINITY, |combination| combination.misfit.abs()))
    })
}

fn free_precession() -> Result<Measured, String> {
    let spheroid = RigidSpheroid::in_units_of_tc(1.1);
    let free = free_precession_rates(&spheroid, 1.0, 0.7)?;
    let angles = EulerAngles { alpha: 0.4, beta: 0.7, gamma: 0.2 };
    let rates = EulerRates { alpha: free.alpha, beta: 0.0, gamma: free.gamma };
    let motion = Problem::from_angles(spheroid, Matrix3::zeros(), &angles, &rates)?.taylor((0.0, 2000.0), 1e-15)?;
    let (beam, observer) = (beam(), line_of_sight());
    let list = |observable: &dyn Fn(&BodyState<f64>) -> f64| {
        Ok::<_, String>(spectral_lines(&Series::of_motion(&motion, 4096, observable)?, 1e-9, 20)?)
    };
    let (a, g) = (free.alpha, free.gamma.abs());
    let mut worst = Worst::default();
    for (name, list, expected) in [
        ("m.n", list(&|state| beam.direction(state).dot(&observer))?, vec![g, a - g, a, a + g]),
        ("h_+", list(&|state| wave_of(&motion, state).plus)?, vec![a, 2.0 * a]),
        ("h_x", list(&|state| wave_of(&motion, state).cross)?, vec![a, 2.0 * a]),
    ] {
        let mut found: Vec<f64> = list.lines.iter().map(|line| line.frequency).collect();
        found.sort_by(f64::total_cmp);
        let same = found.len() == expected.len() && found.iter().zip(&expected).all(|(x, y)| (x - y).abs() < 1e-11);
        let figure = if same { list.remainder } else { f64::INFINITY };
        worst.see(figure, || format!("{name}: lines {found:.9?}, remainder {:.1e}", list.remainder));
    }
    worst.finish()
}

fn slow_line_of_tp_2() -> Result<Measured, String> {
    let example = &examples()?[1];
    let line = strongest(&example.pulsar, 0.03..0.04)?;
    let rate = example.frequencies.momentum.ok_or("L has no mean azimuth")?.value;
    let highest = example.pulsar.lines[0].amplitude;
    let figure = if line.amplitude > 0.1 * highest { (line.frequency - rate.abs()).abs() } else { f64::INFINITY };
    Ok(Measured::new(figure, format!("amplitude {:.3} of the highest", line.amplitude / highest)))
}

fn slow_line_of_tp_1() -> Result<Measured, String> {
    let example = &examples()?[0];
    let (alpha, momentum) = (example.frequencies.alpha, example.frequencies.momentum);
    let locked = alpha.zip(momentum).is_some_and(|(a, l)| (a.value - l.value).abs() < 1e-11);
    let line = strongest(&example.pulsar, SLOW)?;
    let ratio = line.amplitude / example.pulsar.lines[0].amplitude;
    let what = example.basis.identify(line.frequency, line.uncertainty);
    // Of L averaged over the fast rotation, which turns at a rate of its own.
    let slow = example.frequencies.slow.ok_or("no slow precession")?.value;
    let there = (line.frequency - slow.abs()).abs() < 1e-9;
    let figure = if locked && there { ratio } else { f64::INFINITY };
    Ok(Measured::new(figure, format!("{:.7}: {what}, 1/{:.0} of the highest", line.frequency, 1.0 / ratio)))
}

fn slow_line_of_waves() -> Result<Measured, String> {
    worst_of(examples()?, |example| {
        Ok(largest(example.waves().map(|(_, list)| {
            // A list without a line there has none above its least amplitude.
            strongest(list, SLOW).map_or(1e-6, |line| line.amplitude) / list.lines[0].amplitude
        })))
    })
}

fn slow_magnitude() -> Result<Measured, String> {
    let slow = examples()?[1].frequencies.slow.ok_or("no slow precession")?.value;
    let s = COEFFICIENTS;
    let mean = (s.xx * s.yy * s.zz).abs().cbrt();
    Ok(Measured::new(slow.abs() / mean, format!("slow frequency {slow:.8}, coefficients {} to {}", s.yy, s.zz.abs())))
}

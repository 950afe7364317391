//! `twofold timing`.

use clap::Args;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use twofold::epoch::{DAY, Epoch};

use super::output_folder::OutputFolder;
use super::run::read_with_spin_down;
use super::{Failure, note, tell};
use crate::figures::{png, residuals};
use twofold_scene::Refusal;
use twofold_scene::pulsar_timing::{PulsarScene, Series, Timing, csv, decimal, par, strain_series, tim};
use twofold_scene::scene_file::{Columns, MOST_SAMPLES, Scene, like_julian_date};

#[derive(Args)]
pub(crate) struct TimingArgs {
    /// A built-in scene (see `twofold scenes`) or the path of a scene file (TOML), with `time.epoch`, [observer] and [pulsar]
    pub(crate) scene: String,
    /// First epoch (MJD, TDB); if not given, that of the scene
    #[arg(long, value_name = "MJD", value_parser = date)]
    pub(crate) from: Option<Epoch>,
    /// Last epoch; if not given, the end of the scene's span
    #[arg(long, value_name = "MJD", value_parser = date)]
    pub(crate) to: Option<Epoch>,
    /// Days between epochs
    #[arg(long, value_name = "DAYS", conflicts_with = "epochs", allow_hyphen_values = true)]
    pub(crate) every: Option<f64>,
    /// Number of epochs, both ends included
    #[arg(long, value_name = "NUMBER")]
    pub(crate) epochs: Option<usize>,
    /// Fit F0 and F1 only, also for a scene with [spin_down]; what F1 absorbs is not a signature of precession
    #[arg(long, conflicts_with = "f2")]
    pub(crate) f1: bool,
    /// Fit F0, F1 and F2, the default for a scene with [spin_down]
    #[arg(long)]
    pub(crate) f2: bool,
    /// Add the causes of the residuals to the table: geometry, torque and the direct effect of Lorentz violation; also the rate of change of the frequency
    #[arg(long)]
    pub(crate) causes: bool,
    /// Uncertainty of the arrival times as written to the .tim, in microseconds
    #[arg(long, value_name = "US", default_value = "1", allow_hyphen_values = true)]
    pub(crate) uncertainty: f64,
    /// Length of the strain series in seconds, from the first epoch on; 64 turns if not given
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true)]
    pub(crate) strain_span: Option<f64>,
    /// Samples of strain per second; a power of two if not given
    #[arg(long, value_name = "HZ", allow_hyphen_values = true)]
    pub(crate) strain_rate: Option<f64>,
    /// Folder for the files, created if it does not exist
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Replace files that exist
    #[arg(long)]
    pub(crate) force: bool,
}

pub(super) fn timing(args: &TimingArgs) -> Result<(), Failure> {
    let scene = read_with_spin_down(&args.scene, Columns::Unused)?;
    for (option, date) in [("--from", &args.from), ("--to", &args.to)] {
        if let Some(why) = date.as_ref().and_then(like_julian_date) {
            note(&format!("{option}: {why}"));
        }
    }
    let refused = |why: String| Failure::BadInput(format!("{}: {why}", args.scene));
    let pulsar = PulsarScene::new(&scene).map_err(refused)?;
    let epochs = epochs(args, &scene, &pulsar.epoch)?;
    positive("--uncertainty", args.uncertainty)?;
    let series = series(args, &epochs, pulsar.clock.period())?;
    let name =
        Path::new(&args.scene).file_stem().map_or_else(|| args.scene.clone(), |stem| stem.to_string_lossy().into());
    let file = |ending: &str| format!("{name}.{ending}");
    let endings = ["csv", "par", "tim", "svg", "png", "h_plus.txt", "h_cross.txt"];
    let folder = OutputFolder::at(&args.out, args.force, |found| endings.iter().any(|ending| found == file(ending)))?;
    let derivatives = match (args.f1, args.f2 || scene.spin_down.is_some()) {
        (true, _) => 1,
        (false, true) => 2,
        (false, false) => 0,
    };
    let timing = pulsar.timed(&epochs, derivatives).map_err(|error| match error {
        Refusal::Input(why) => refused(why),
        Refusal::Model(error) => error.into(),
    })?;
    let causes = args.causes.then(|| pulsar.causes(&timing)).transpose().map_err(refused)?;
    folder.write(&file("csv"), csv(&pulsar, &timing, causes.as_ref()).as_bytes())?;
    folder.write(&file("par"), par(&scene, &timing)?.as_bytes())?;
    folder.write(&file("tim"), tim(&timing, args.uncertainty * 1e-6).as_bytes())?;
    let picture = residuals(&name, &timing, causes.as_ref());
    let drawn = png(&picture).map_err(|why| Failure::Failed(format!("{}: {why}", file("png"))))?;
    folder.write(&file("svg"), picture.as_bytes())?;
    folder.write(&file("png"), &drawn)?;
    let strain = strain_series(&pulsar, &series)?;
    match &strain {
        Some([plus, cross]) => {
            folder.write(&file("h_plus.txt"), plus.as_bytes())?;
            folder.write(&file("h_cross.txt"), cross.as_bytes())?;
        }
        None => note("no strain: the scene lacks `observer.distance`"),
    }
    let files = folder.complete()?;
    if args.force && strain.is_none() {
        // Files of an earlier scene with this name do not belong to the new ones.
        for old in ["h_plus.txt", "h_cross.txt"] {
            let _ = std::fs::remove_file(args.out.join(file(old)));
        }
    }
    left_out(epochs.len(), timing.pulses.len(), timing.dark).iter().for_each(|why| note(why));
    let distances = epochs.iter().map(|at| at.seconds_since(&pulsar.epoch)[0].abs());
    let farthest = distances.max_by(f64::total_cmp).expect("an epoch: the fit needs two pulses");
    note(&format!(
        "estimated error of the residuals: {:.1e} s; an arrival time is rounded to 1e-16 d, 8.6e-12 s",
        pulsar.residual_error(farthest)
    ));
    note(&format!(
        "estimated error of the arrival times themselves: {:.1e} s at the farthest epoch; its excess over that of the residuals comes from \
         the rounding of the initial angular momentum, is linear in time and is absorbed by F0",
        pulsar.arrival_error(farthest)
    ));
    note_periods(&pulsar, &epochs);
    tell(&format!("{}: {} arrival times, {files} files\n{}", args.out.display(), timing.pulses.len(), summary(&timing)))
}

fn summary(timing: &Timing) -> String {
    let (fit, first) = (&timing.fit, &timing.pulses[0]);
    let derivatives = [("F1", "Hz/s"), ("F2", "Hz/s^2")].into_iter().zip(fit.derivatives).take(timing.derivatives);
    let rate: String = derivatives.map(|((name, unit), value)| format!(", {name} = {value:e} {unit}")).collect();
    let sizes = fit.residuals.iter().map(|residual| residual.abs());
    format!(
        "F0 = {} Hz at MJD {}{rate}; residuals: rms {:.3e} s, largest {:.3e} s\nfirst pulse {} at MJD {}\n",
        decimal(fit.frequency),
        timing.epoch,
        timing.root_mean_square(),
        sizes.fold(0.0, f64::max),
        first.pulse.number,
        first.arrival,
    )
}

/// Notes the periods of both precessions, and warns if the epochs are too sparse to show that of the body.
fn note_periods(pulsar: &PulsarScene, epochs: &[Epoch]) {
    let Ok(rates) = pulsar.clock.precession_rates() else { return };
    let [of_body, of_momentum] = rates.map(|rate| TAU / rate.abs() / DAY);
    let days = |period: f64| if period.is_finite() { format!("{period:.6e} d") } else { "none".to_owned() };
    note(&format!(
        "precession period of the body about its axis: {}; of its angular momentum: {}",
        days(of_body),
        days(of_momentum)
    ));
    let apart = days_apart(epochs.iter().map(|at| at.seconds_since(&pulsar.epoch)[0]));
    if apart > 0.5 * of_body {
        note(&format!(
            "epochs are {apart:.3e} d apart, more than half of the precession period of the body: signals at that period are aliased"
        ));
    }
}

/// Mean time (d) between times (s) in any order; NaN for fewer than two.
pub(super) fn days_apart(times: impl ExactSizeIterator<Item = f64>) -> f64 {
    let intervals = times.len() as f64 - 1.0;
    let ends = times.fold([f64::INFINITY, f64::NEG_INFINITY], |[first, last], t| [first.min(t), last.max(t)]);
    if intervals > 0.0 { (ends[1] - ends[0]) / intervals / DAY } else { f64::NAN }
}

/// Why the epochs `asked` for have fewer `pulses`: several in one turn, or no pulse in a turn (`dark`).
fn left_out(asked: usize, pulses: usize, dark: usize) -> Vec<String> {
    let (shared, mut reasons) = (asked - pulses - dark, Vec::new());
    if shared > 0 {
        let are = if shared == 1 { "is" } else { "are" };
        reasons.push(format!(
            "{shared} of {asked} epochs {are} in the same turn as an earlier one; each pulse is written once"
        ));
    }
    if dark > 0 {
        let have = if dark == 1 { "has" } else { "have" };
        reasons.push(format!(
            "{dark} of {asked} epochs {have} no pulse: in that turn the line of sight stays outside the beam, or inside it for longer than the \
             search covers, one and a half turns either way"
        ));
    }
    reasons
}

/// The requested epochs, from the scene or from the options.
fn epochs(args: &TimingArgs, scene: &Scene, epoch: &Epoch) -> Result<Vec<Epoch>, Failure> {
    let start = scene.times.start();
    let of_time = |t: f64| epoch.after([t - start, 0.0]);
    if args.from.is_none() && args.to.is_none() && args.every.is_none() && args.epochs.is_none() {
        return Ok(scene.times.iter().map(of_time).collect::<Result<_, _>>()?);
    }
    let from = args.from.map_or_else(|| of_time(start), Ok)?;
    let to = args.to.map_or_else(|| of_time(scene.times.last()), Ok)?;
    let [seconds, _] = to.seconds_since(&from);
    if seconds <= 0.0 {
        return Err(Failure::BadInput(format!(
            "epochs from {from} to {to}: the last must be later than the first (--from, --to, or the scene's span)"
        )));
    }
    let days = seconds / DAY;
    let (count, step) = match args.every {
        Some(every) => {
            positive("--every", every)?;
            (intervals(days, every) + 1.0, every)
        }
        None => {
            let count = args.epochs.unwrap_or(scene.times.count());
            (count as f64, days / (count.max(2) - 1) as f64)
        }
    };
    if !(2.0..=MOST_SAMPLES as f64).contains(&count) {
        return Err(Failure::BadInput(format!("the number of epochs is {count}: must be from 2 to {MOST_SAMPLES}")));
    }
    let epochs = (0..count as usize).map(|k| from.after([k as f64 * step * DAY, 0.0]));
    Ok(epochs.collect::<Result<_, _>>()?)
}

fn series(args: &TimingArgs, epochs: &[Epoch], period: f64) -> Result<Series, Failure> {
    // Sixteen samples in the shorter period of the wave, rounded up to a power of two.
    let rate = args.strain_rate.unwrap_or_else(|| (32.0 / period).log2().ceil().exp2());
    let span = args.strain_span.unwrap_or(64.0 * period);
    positive("--strain-rate", rate)?;
    positive("--strain-span", span)?;
    let samples = (rate * span).ceil();
    if !(2.0..=MOST_SAMPLES as f64).contains(&samples) {
        return Err(Failure::BadInput(format!(
            "the number of samples of strain is {samples}: must be from 2 to {MOST_SAMPLES}"
        )));
    }
    Ok(Series { start: epochs[0], rate, samples: samples as usize })
}

fn positive(option: &str, value: f64) -> Result<(), Failure> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(Failure::BadInput(format!("{option} {value}: must be a number above zero")))
}

pub(super) fn date(text: &str) -> Result<Epoch, String> {
    text.parse().map_err(|_| "must be a modified Julian date from 0 to 1e7, such as 55321.25".to_owned())
}

/// How often `every` fits into a span. The quotient of decimal numbers can be below a whole number by the rounding of both day fractions and by its
/// own.
fn intervals(days: f64, every: f64) -> f64 {
    let rounding = 2.0 * f64::EPSILON / every + 4.0 * f64::EPSILON * days / every;
    (days / every + rounding).floor()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(clap::Parser)]
    struct Line {
        #[command(flatten)]
        args: TimingArgs,
    }

    /// The arguments of `twofold timing b1828-11 --out x` followed by `more`.
    fn args(more: &[&str]) -> TimingArgs {
        let line = ["timing", "b1828-11", "--out", "x"].iter().chain(more);
        <Line as clap::Parser>::try_parse_from(line).expect("arguments").args
    }

    #[test]
    fn epochs_go_from_the_first_to_the_last() {
        let scene = Scene::named("b1828-11").expect("a scene");
        let start = date("49621").expect("a date");
        // Times in days after the epoch of the scene.
        let days = |more: &[&str]| {
            let found = epochs(&args(more), &scene, &start)?;
            Ok::<Vec<f64>, Failure>(found.iter().map(|at| at.seconds_since(&start)[0] / DAY).collect())
        };
        let of_scene: Vec<f64> = scene.times.iter().map(|t| (t - scene.times.start()) / DAY).collect();
        assert_eq!(days(&[]).expect("epochs"), of_scene);
        let (count, last) = (of_scene.len(), of_scene[of_scene.len() - 1]);
        let near = |found: &[f64], expected: &[f64]| {
            found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9 * last)
        };
        let [found, late, early] = [&[][..], &["--from", "49622"], &["--to", "49623"]]
            .map(|more| days(&[&["--epochs", "2"], more].concat()).expect("epochs"));
        assert!(near(&found, &[0.0, last]) && near(&late, &[1.0, last]) && near(&early, &[0.0, 2.0]));
        // The number of epochs is that of the scene, unless another number or their distance is given.
        for (more, first, end) in [(["--from", "49622"], 1.0, last), (["--to", "49623"], 0.0, 2.0)] {
            let found = days(&more).expect("epochs");
            assert!(found.len() == count && near(&[found[0], found[count - 1]], &[first, end]), "{more:?}: {found:?}");
        }
        let every = ["--to", "49623", "--every", "0.75"];
        assert!(near(&days(&every).expect("epochs"), &[0.0, 0.75, 1.5]));
        // Half a second is a span, zero is not.
        assert!(days(&["--to", "49621.000005", "--epochs", "2"]).is_ok());
        for refused in [&["--to", "49621"][..], &["--epochs", "1"], &["--every", "0"], &["--every", "1e9"]] {
            assert!(days(refused).is_err(), "{refused:?}");
        }
    }

    #[test]
    fn strain_has_sixteen_samples_in_the_period_of_its_second_harmonic() {
        let of = |more: &[&str]| {
            let found = series(&args(more), &[date("49621").expect("a date")], 0.25)?;
            Ok::<_, Failure>((found.rate, found.samples))
        };
        // 16 / (0.25 s / 2), a power of two, and 64 periods.
        assert!(of(&[]).is_ok_and(|found| found == (128.0, 2048)));
        assert!(of(&["--strain-rate", "100"]).is_ok_and(|found| found == (100.0, 1600)));
        assert!(of(&["--strain-span", "1"]).is_ok_and(|found| found == (128.0, 128)));
        assert!(of(&["--strain-rate", "1", "--strain-span", "2"]).is_ok_and(|found| found == (1.0, 2)));
        for refused in [["--strain-rate", "0"], ["--strain-span", "0"], ["--strain-span", "0.005"]] {
            assert!(of(&refused).is_err(), "{refused:?}");
        }
        assert!(of(&["--strain-rate", "1e6", "--strain-span", "10.1"]).is_err());
    }

    #[test]
    fn days_apart_do_not_depend_on_the_order() {
        let days = |times: &[f64]| days_apart(times.iter().map(|day| day * DAY));
        assert_eq!(days(&[13.0, 10.0, 11.0]), 1.5);
        assert_eq!(days(&[-2.0, -1.0]), 1.0);
        assert!(days(&[4.0]).is_nan() && days(&[]).is_nan());
    }

    #[test]
    fn epochs_without_a_pulse_of_their_own_are_told_by_reason() {
        assert_eq!(left_out(9, 9, 0), [""; 0]);
        let both = left_out(9, 7, 1);
        assert!(both[0].starts_with("1 of 9 epochs is in the same turn"), "{both:?}");
        assert!(both[1].starts_with("1 of 9 epochs has no pulse"), "{both:?}");
        let both = left_out(9, 2, 4);
        assert!(both[0].starts_with("3 of 9 epochs are in the same turn"), "{both:?}");
        assert!(both[1].starts_with("4 of 9 epochs have no pulse"), "{both:?}");
    }

    /// Dates and steps in thousandths of a day, of which a whole number fits into the span; and a span that is a tenth of a second shorter.
    #[test]
    fn a_whole_number_of_decimal_steps_is_counted() {
        let date = |thousandths: u32| {
            Epoch::new(50_000 + i64::from(thousandths / 1000), f64::from(thousandths % 1000) / 1000.0).unwrap()
        };
        for step in [1, 3, 7, 100, 700, 3300] {
            let every = f64::from(step) / 1000.0;
            for first in [0, 1, 399, 999] {
                for number in (1..100_000).step_by(37) {
                    let [seconds, _] = date(first + number * step).seconds_since(&date(first));
                    assert_eq!(intervals(seconds / DAY, every), f64::from(number), "{every} from {first}");
                    assert_eq!(intervals((seconds - 0.1) / DAY, every), f64::from(number - 1), "{every} from {first}");
                }
            }
        }
    }
}

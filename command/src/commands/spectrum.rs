//! `twofold spectrum`.

use clap::Args;
use twofold::Error;

use super::explain::explained;
use super::run::{OutputArgs, PlanArgs, force_method, read_scene, write};
use super::{Failure, note, print};
use twofold_scene::columns::Column;
use twofold_scene::estimated_error::as_printed;
use twofold_scene::scene_file::{Columns, Scene, Times};
use twofold_scene::trajectory::{Floor, LinesSummary, LinesWanted, Sampling, TrajectoryError};

#[derive(Args)]
pub(crate) struct SpectrumArgs {
    /// A built-in scene (see `twofold scenes`) or the path of a scene file (TOML)
    pub(crate) scene: String,
    /// The column, by its name in the header of `twofold run`, without the unit: m.n, h_plus, cos_lambda, beta, ...
    #[arg(long, value_name = "COLUMN")]
    pub(crate) of: String,
    /// The lines, or the amplitudes at equally spaced frequencies by a Fourier transform
    #[arg(long, value_enum, default_value = "lines")]
    pub(crate) table: SpectrumTable,
    /// Length of the series in the scene's unit of time, instead of the scene's span
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(crate) span: Option<f64>,
    /// Least amplitude of a line, as a part of the largest one
    #[arg(long, value_name = "RATIO", default_value = "1e-6")]
    pub(crate) least: f64,
    /// Most lines that are written, the strongest first
    #[arg(long, value_name = "NUMBER", default_value = "50", value_parser = clap::value_parser!(u8).range(1..=200))]
    pub(crate) most: u8,
    /// Do not name the lines, which asks for a longer span than to find them
    #[arg(long)]
    pub(crate) unidentified: bool,
    #[command(flatten)]
    pub(crate) plan: PlanArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

#[derive(Clone, Copy, clap::ValueEnum)]
pub(crate) enum SpectrumTable {
    Lines,
    Spectrum,
}

pub(super) fn spectrum(args: &SpectrumArgs) -> Result<(), Failure> {
    let mut scene = read_scene(&args.scene, Columns::Unused)?;
    if let Some(span) = args.span {
        let (start, end) = (scene.times.start(), scene.times.start() + span);
        if !end.is_finite() || start == end {
            return Err(Failure::BadInput(format!(
                "--span {span:?}: allowed is a finite number, not zero beside `time.start`"
            )));
        }
        scene.times = Times::Even { start, end, samples: 2 };
    }
    force_method(&mut scene, &args.plan, &args.scene)?;
    let column = Column::oscillating(&args.of, &scene)
        .map_err(|why| Failure::BadInput(format!("--of for {}: {why}", args.scene)))?;
    if !(1e-12..=1.0).contains(&args.least) {
        return Err(Failure::BadInput(format!("--least {:?}: allowed is from 1e-12 to 1", args.least)));
    }
    Sampling::check(&scene).map_err(|why| Failure::BadInput(format!("{}: {why}", args.scene)))?;
    let wanted = LinesWanted { least: args.least, most: usize::from(args.most), identified: !args.unidentified };
    let identified = wanted.identified && matches!(args.table, SpectrumTable::Lines);
    let plan = Sampling::plan(&scene, &column, identified)?;
    if args.plan.explain {
        return print(&explained(&scene, &plan));
    }
    let summary = write(&args.output, &scene, |writer, _| {
        let sampling = Sampling::of(&scene, &column, &plan)?;
        note_sampling(&scene, &column, &sampling);
        match args.table {
            SpectrumTable::Lines => sampling.write_lines(&scene, &column, &wanted, writer).map(Some).map_err(rounded),
            SpectrumTable::Spectrum => sampling.write_spectrum(&scene, &column, writer).map(|()| None),
        }
    })?;
    if let Some(Some(summary)) = summary {
        note_lines(&scene, &column, &summary);
    }
    Ok(())
}

/// The error with the number in it as a reader wants it: three digits of the span that is too short.
fn rounded(error: TrajectoryError) -> TrajectoryError {
    match error {
        TrajectoryError::NoFrequencies(Error::Domain { quantity, value, allowed }) => {
            let value = format!("{value:.2e}").parse().unwrap_or(value);
            TrajectoryError::NoFrequencies(Error::Domain { quantity, value, allowed })
        }
        error => error,
    }
}

fn note_sampling(scene: &Scene, column: &Column, sampling: &Sampling) {
    let (count, step, highest) = sampling.describe(scene);
    let time = scene.units.time_name;
    note(&format!(
        "{} at {count} times {step:.6e} {time} apart, chosen from the rotation rate; frequencies up to {highest:.6e} rad/{time}",
        column.name
    ));
}

fn note_lines(scene: &Scene, column: &Column, summary: &LinesSummary) {
    let (name, time) = (&column.name, scene.units.time_name);
    let unit = if column.unit == "1" { String::new() } else { format!(" {}", column.unit) };
    match &summary.fundamental {
        None => {}
        Some(Ok(fundamental)) => {
            for g in fundamental {
                let uncertainty = as_printed(g.uncertainty, 0.5 * f64::EPSILON * g.frequency.abs());
                note(&format!("{} = {:?} +- {uncertainty:.1e} rad/{time}", g.symbol, g.frequency));
            }
        }
        Some(Err(why)) => note(&format!("no line is identified: the motion has no fundamental frequencies: {why}")),
    }
    note(&format!("{name} has the constant term {:?}{unit}", summary.constant));
    let least = format!("{:.1e}{unit}", summary.least);
    match summary.floor {
        Floor::Wanted => {}
        Floor::Tolerance(size) => note(&format!(
            "lines below {least} are not listed: the scene's tolerance is {:.0e}, of {size:.1e}{unit}",
            scene.tolerance
        )),
        Floor::Noise => note(&format!(
            "lines below {least} are not listed: that is six times the noise, what is left or the rounding of the values and their times"
        )),
    }
    if summary.lines == 0 {
        note(&format!("{name} has no line of an amplitude above {least}"));
    }
    if summary.found > summary.lines {
        note(&format!("{} lines were found; --most writes more of them", summary.found));
    }
    if summary.remainder >= summary.least {
        let part = match summary.strongest {
            0.0 => String::new(),
            strongest => format!(", {:.1e} of the strongest line", summary.remainder / strongest),
        };
        note(&format!(
            "lines are missing: an amplitude of {:.1e}{unit} is left{part}, which the uncertainties count; lines nearer than about \
             {:.1e} rad/{time} (8 / span) to one another or to zero are taken for one, or for the constant term, and a longer --span \
             separates them",
            summary.remainder, summary.resolution
        ));
    }
    if summary.unresolved > 0 {
        note(&format!(
            "{} of the lines listed are `unresolved`: the frequency is uncertain by more than 1 / span, and the line may stand for several",
            summary.unresolved
        ));
    }
    if summary.near_highest > 0 {
        note(&format!(
            "{} of the lines are near the highest frequency, where others may be folded back from above it",
            summary.near_highest
        ));
    }
}

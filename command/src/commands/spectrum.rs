//! `twofold spectrum`.

use clap::Args;

use super::run::{OutputArgs, read_scene, write};
use super::{Failure, note};
use twofold_scene::columns::Column;
use twofold_scene::scene_file::Columns;
use twofold_scene::trajectory::{LinesSummary, LinesWanted, write_lines};

#[derive(Args)]
pub(crate) struct SpectrumArgs {
    /// A built-in scene (see `twofold scenes`) or the path of a scene file (TOML)
    pub(crate) scene: String,
    /// The column to analyse, by its name in the header of `twofold run`, without the unit: m.n, h_plus, cos_lambda, beta, ...
    #[arg(long, value_name = "COLUMN")]
    pub(crate) of: String,
    /// Least amplitude of a line, as a fraction of the largest one
    #[arg(long, value_name = "RATIO", default_value = "1e-6")]
    pub(crate) least: f64,
    /// Largest number of lines that are written, the strongest first
    #[arg(long, value_name = "NUMBER", default_value = "50", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) most: u32,
    /// Write frequencies in turns per unit of time (Hz if that is the second), not in rad
    #[arg(long)]
    pub(crate) hertz: bool,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

pub(super) fn spectrum(args: &SpectrumArgs) -> Result<(), Failure> {
    let scene = read_scene(&args.scene, Columns::Unused)?;
    let column = Column::oscillating(&args.of, &scene)
        .map_err(|why| Failure::BadInput(format!("--of for {}: {why}", args.scene)))?;
    if !(1e-12..=1.0).contains(&args.least) {
        return Err(Failure::BadInput(format!("--least {:?}: must be from 1e-12 to 1", args.least)));
    }
    let wanted = LinesWanted { least: args.least, most: args.most as usize, in_turns: args.hertz };
    if let Some(summary) = write(&args.output, &scene, |writer, _| write_lines(&scene, &column, &wanted, writer))? {
        note_lines(&column, &summary);
    }
    Ok(())
}

fn note_lines(column: &Column, summary: &LinesSummary) {
    let name = &column.name;
    let unit = if column.unit == "1" { String::new() } else { format!(" {}", column.unit) };
    for frequency in &summary.fundamental {
        note(&format!("{} = {:?} {}", frequency.symbol, frequency.rate, summary.unit));
    }
    let [x, y, z] = summary.pole;
    if z < 1.0 {
        // Without the sign of a zero.
        let [x, y, z] = [x, y, z].map(|part| if part.abs() < 5e-7 { 0.0 } else { part });
        note(&format!(
            "these are rates of angles about the axis ({x:.6}, {y:.6}, {z:.6}), about which L precesses, not about Z"
        ));
    }
    note(&format!("{name} has the constant term {:?}{unit}", summary.constant));
    if let Some(rounding) = summary.rounding {
        note(&format!("lines below {rounding:.1e}{unit} are not listed, because rounding alone gives such lines"));
    }
    note(&format!(
        "{name} differs from the sum of its constant and all lines found by up to {:.1e}{unit} in sixteen states",
        summary.left
    ));
    if summary.written == 0 {
        note(&format!("{name} has no line"));
    }
    if summary.found > summary.written {
        note(&format!("{} lines were found; use a larger --most to write more of them", summary.found));
    }
}

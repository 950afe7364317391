//! The command with arguments from a fuzzer, executed in this process if the work is small.

use std::path::Path;
use std::process::ExitCode;
use std::sync::OnceLock;
use std::{env, fs};

use clap::Parser;
use tempfile::TempDir;

use super::scene::is_small;
use crate::commands::{Cli, Command, FisherArgs, ForecastArgs, MeasurementArgs, run_command};
use twofold_scene::scene_file::{Columns, Scene};
use twofold_scene::sweep::{Sweep, SweepText};

const FILES: [(&str, &str); 6] = [
    ("s.toml", include_str!("../../../scene/scenes/tp-1.toml")),
    ("p.toml", include_str!("../../../scene/scenes/b1937+21.toml")),
    ("bounds.toml", twofold_scene::pulsar_table::PAPER),
    (
        "g.toml",
        "scene = \"s.toml\"\n[[vary]]\nparameter = \"pulsar.rho\"\nvalues = [0.5, 0.6]\n[time]\ntimes = [1.0]\n",
    ),
    (
        "d.csv",
        "beam,turn,midpoint [t_c],duration [t_c],closest_approach [t_c],period [t_c]\n1,1,4.2,0.3,4.2,\n1,2,8.4,0.3,8.4,4.2\n",
    ),
    ("t.tim", "FORMAT 1\na 0 55321.25 1 @\na 0 55421.5 1 @\na 0 56421.75 1 @\na 0 57521 1 @\na 0 58621 1 @\n"),
];

/// Arguments, one per line: parsed, and executed in a separate folder if the work is small and no path leads out of it.
pub fn command_line(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let Ok(cli) = Cli::try_parse_from(["twofold"].into_iter().chain(text.lines())) else { return };
    let Some(command) = cli.command else { return };
    // Arguments that could reach a file of the machine are only parsed.
    if text.contains(['/', '\\', '~']) || text.contains("..") {
        return;
    }
    let folder = folder();
    env::set_current_dir(folder).expect("a folder");
    if is_little_work(&command) {
        let status = run_command(command);
        let known = [0, 1, 2, 3].map(ExitCode::from);
        assert!(known.contains(&status), "{status:?}");
    }
    clean(folder);
}

fn folder() -> &'static Path {
    static FOLDER: OnceLock<TempDir> = OnceLock::new();
    let folder = FOLDER.get_or_init(|| {
        let folder = tempfile::tempdir().expect("a folder");
        let short = |text: &str| text.replace("span = 400", "span = 20").replace("samples = 4001", "samples = 21");
        for (name, text) in FILES {
            fs::write(folder.path().join(name), short(text)).expect("a file");
        }
        folder
    });
    folder.path()
}

/// Removes the output of a command; an unfinished file without its mark is a fault.
fn clean(folder: &Path) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let entry = entry.expect("an entry");
        let name = entry.file_name().to_string_lossy().into_owned();
        if FILES.iter().any(|(file, _)| *file == name) {
            continue;
        }
        assert!(!name.ends_with(".part"), "{name} is left");
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        let removed = if is_folder { fs::remove_dir_all(entry.path()) } else { fs::remove_file(entry.path()) };
        removed.expect("removed");
    }
}

/// Whether a command takes only milliseconds.
fn is_little_work(command: &Command) -> bool {
    let short = |name: &str| match Scene::named_with(name, Columns::Unused) {
        Ok(scene) => is_small(&scene) || name == "p.toml",
        Err(_) => true,
    };
    let measured = |args: &MeasurementArgs| short(&args.scene) && args.scene != "p.toml";
    match command {
        Command::Run(args) => args.plan.explain || short(&args.scene),
        Command::Pulses(args) => args.plan.explain || short(&args.scene) && args.scene != "p.toml",
        Command::Spectrum(args) => short(&args.scene),
        Command::Timing(args) => {
            let samples = args.strain_span.unwrap_or(1.0).abs() * args.strain_rate.unwrap_or(1e3).abs();
            let every = args.every.is_none_or(|days| !(0.0..1.0).contains(&days));
            let is_refused = |number: f64| number.is_nan() || number > 1e7;
            let few = args.epochs.is_none_or(|count| count <= 100 || is_refused(count as f64));
            few && every && (samples < 1e4 || is_refused(samples))
        }
        Command::Sweep(args) => {
            let read = |text: &SweepText| Sweep::new(text).map_or(0, |sweep| sweep.scenes);
            SweepText::read(&args.file).map_or(true, |text| read(&text) <= 10)
        }
        Command::Fisher(FisherArgs { measurement, .. }) => measured(measurement),
        Command::Fit(args) => measured(&args.measurement),
        Command::Forecast(ForecastArgs { fisher, spans, epochs, .. }) => {
            let spans = spans.as_ref().is_none_or(|spans| spans.iter().all(|span| span.is_nan() || *span < 50.0));
            measured(&fisher.measurement) && spans && epochs.iter().all(|count| *count <= 50)
        }
        Command::Limits(args) => args.periods.is_none_or(|periods| periods.number <= 10),
        Command::Bounds(_) | Command::Compare(_) | Command::Scenes(_) | Command::Equations => true,
        Command::Figures(args) => args.list,
        Command::Verify(args) => args.filter.as_ref().is_some_and(|filter| filter.contains('?')),
        Command::Report(_) | Command::Bench(_) | Command::Claims | Command::Stability(_) => false,
    }
}

//! The command `twofold`: verify the paper's equations, run a scene, list the scenes, bounds from pulsars.

mod bench;
mod bounds;
mod compare;
mod figures;
mod fisher;
mod fit;
mod forecast;
mod inference_arguments;
mod interrupt;
mod limits;
mod measurement;
mod output_file;
mod output_folder;
mod progress;
mod pulses;
mod report;
mod run;
mod scenes;
mod spectrum;
mod standard_output;
mod sweep;
mod timing;
mod verify;

use std::ffi::OsString;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};
use twofold::Error;
use twofold_scene::scene_file::{SceneError, counted};
use twofold_verify::{claims, equation_table, stability};

pub(crate) use inference_arguments::{FisherArgs, FitArgs, ForecastArgs, MeasurementArgs, TableArgs};
use standard_output::{print, tell};

/// The rotation of spheroidal stars under Lorentz violation, as verified equations
///
/// Without a command, `verify` is run.
#[derive(Parser)]
#[command(name = "twofold", version, max_term_width = 100, after_help = include_str!("../../data/examples.txt").trim_end())]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Run the checks of the paper's equations and print the measured value, the bound and the verdict of each
    ///
    /// A check compares an equation of the paper with something independent of it: exact arithmetic, automatic
    /// derivatives, another method, an invariant. It measures one number, which must meet one bound.
    Verify(verify::VerifyArgs),
    /// Compute the motion of a star, or what an observer sees of it, and write it as CSV
    ///
    /// The header of the table names the columns and their units. A scene in the paper's units has times in
    /// t_c = sqrt(I^xx / C), a scene of a physical star in seconds. Angles are in rad and continuous (unwrapped). Where
    /// the symmetry axis is exactly on a pole they are undefined, and their fields are empty.
    Run(run::RunArgs),
    /// Print the bounds on Lorentz violation from pulsar pulse widths, and one recommended limit with its confidence
    ///
    /// Without a file, the two pulsars of the paper's table are used and compared with its numbers. Published limits follow. The
    /// format of a table and the method are described in docs/bounds.md.
    Bounds(bounds::BoundsArgs),
    /// Find every pulse of a star's radio beam in the span of a scene and write them as CSV
    ///
    /// A pulse is an interval of time in which the line of sight is inside the beam, m.n > cos(rho). The scene must have the
    /// sections [observer] and [pulsar]; only the span of its [time] matters, not the samples. No pulse is missed and none is spurious,
    /// except where an extremum of m.n is within 1e-13 of cos(rho): rounding decides there, and a note gives the first such time.
    Pulses(pulses::PulsesArgs),
    /// Simulate the arrival times of a pulsar over decades, and their timing residuals
    ///
    /// Writes SCENE.csv, SCENE.par and SCENE.tim (FORMAT 1, barycentre), a plot of the residuals as SCENE.svg and SCENE.png and, if the
    /// scene has `observer.distance`, the strain from the first epoch on as SCENE.h_plus.txt and SCENE.h_cross.txt. The pulses are those
    /// nearest to the requested epochs or, without options, to the times of the scene. The averaged motion is used where it is as
    /// accurate as the motion on the torus, and that one elsewhere; docs/pulsars.md describes the files.
    Timing(timing::TimingArgs),
    /// Find the spectral lines of a column of a scene, identify them by the fundamental frequencies of the motion, write them as CSV
    ///
    /// All lines are found, from the exact motion or, of a star with a bulge, the averaged one: the scene's [time] does not matter. Notes on standard error give the fundamental
    /// frequencies, the constant term and the largest residual of the lines.
    Spectrum(spectrum::SpectrumArgs),
    /// Compute many scenes (grids, lists or random draws of the parameters of one), and write a table with one row for each
    ///
    /// The table grows in TABLE.partial and is renamed to TABLE when it is complete. If the command is interrupted, the same command
    /// continues where it stopped, and the table is the same to the byte as without the interruption. A scene that fails has a row
    /// that says so, and a line in TABLE.errors.csv. The format of a sweep file is described in docs/sweep.md.
    Sweep(sweep::SweepArgs),
    /// Compare the data that the paper's authors published with the same numbers computed here
    ///
    /// The files are those of the folder `data3` of github.com/ryxxastroat/lorentz_precession. Each known file in the folder is
    /// read and recomputed; the largest difference of each column is printed next to the known error of the file.
    Compare(compare::CompareArgs),
    /// Draw the paper's figures and ours, each as SVG and PNG, with its caption and its data
    ///
    /// Writes NAME.svg, NAME.png, NAME.md and NAME.csv (or NAME.TABLE.csv) of each figure; the files appear when all are
    /// complete. With --scene the figures of a motion are drawn for a scene in place of the paper's examples.
    Figures(figures::FiguresArgs),
    /// Limits from arrival times and pulse widths: on the wobble against the precession period, on the drift of the spin axis, and from it on the size of s
    ///
    /// Fits the timing model of docs/timing-model.md to barycentred data, starting from a scene, over any number of turns. Prints values with standard deviations, limits at 95 %, and the
    /// parameters that were held fixed.
    Limits(limits::LimitsArgs),
    /// Compute the Fisher matrix: how well measurements of a scene would determine its parameters, and which they cannot determine
    ///
    /// The data are pulse times, widths or strains with independent errors; the derivatives are exact. Prints the marginalised
    /// standard deviation of each parameter; notes on standard error name every combination of parameters that the data do not
    /// determine, with the reason if it is a symmetry. docs/inference.md describes parameters and method.
    Fisher(FisherArgs),
    /// Fit the parameters of a scene to measured series, by least squares, with error bars
    ///
    /// Data are tables of `twofold pulses` or of `twofold run --columns h`. The fit starts from the scene, which must be close enough
    /// that its pulses are those of the data. Parameters that the data do not determine are refused, with the reason.
    Fit(FitArgs),
    /// Forecast the uncertainty of one parameter against the span, the number and the errors of the measurements
    Forecast(ForecastArgs),
    /// Measure the time and the true error of every method, and the cost of what is computed on top of a motion
    ///
    /// Seven scenes of 1,000 t_c have references of 30 digits; the methods are run in turn, and the shortest time of each counts.
    /// Measured next are the growth of errors over long motions, the cost of events, samples, gradients and wider numbers, and how
    /// the time scales with the number of outputs, scenes and cores.
    Bench(bench::BenchArgs),
    /// List the built-in scenes and sweeps, or print the file of one
    Scenes(scenes::ScenesArgs),
    /// Run every check and write everything as one HTML page: claims, equations, checks, golden tables, figures
    ///
    /// The page is DIR/index.html. It needs no network, no script and no other file. If checks fail, the page is still
    /// written and says so at its top; the status is then 1.
    Report(report::ReportArgs),
    /// Print the table of equations: the code that implements each, and the checks and golden numbers about it (Markdown)
    Equations,
    /// Print the paper's statements, each with a verdict and the measurements of the checks behind it (Markdown)
    Claims,
    /// Print the tables of digits lost by every kernel, as Markdown
    #[command(hide = true)]
    Stability(StabilityArgs),
}

#[derive(Args)]
pub(crate) struct StabilityArgs {
    /// Rounds of points, 40 in each case and round as a rule
    #[arg(long, value_name = "COUNT", default_value_t = stability::table::ROUNDS)]
    rounds: u64,
}

/// The unsuccessful ends of a command.
#[derive(Debug)]
pub(crate) enum Failure {
    /// A check or a computation failed: status 1.
    Failed(String),
    /// The input cannot be used: status 2.
    BadInput(String),
    /// Everything is written, but some of it could not be computed: status 3.
    Partly(String),
    /// Ended by a signal, with a note of what remains: status 130.
    Interrupted(String),
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Failed(error.to_string())
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Self::BadInput(error.to_string())
    }
}

/// Runs the command with the arguments of the process.
pub fn main() -> ExitCode {
    if let Err(error) = interrupt::watch() {
        return end(1, &format!("signals cannot be handled: {error}"));
    }
    match Cli::try_parse() {
        Ok(cli) => match out_that_is_read(std::env::args_os()) {
            Some(out) => end(2, &also_read(&out)),
            None => run_command(cli.command.unwrap_or(Command::Verify(verify::VerifyArgs::default()))),
        },
        Err(misuse) if misuse.use_stderr() => {
            let _ = misuse.print();
            ExitCode::from(2)
        }
        Err(help_or_version) => status(print(&help_or_version.render().to_string())),
    }
}

/// The file named by `--out` if another argument is the same file: an output, even with `--force`, must not replace an input.
fn out_that_is_read(arguments: impl Iterator<Item = OsString>) -> Option<PathBuf> {
    let (mut out, mut others, mut is_next) = (None, Vec::new(), false);
    // After the names of the program and of the command.
    for argument in arguments.skip(2) {
        let text = argument.to_string_lossy().into_owned();
        match text.strip_prefix("--out=") {
            Some(path) => out = Some(PathBuf::from(path)),
            None if is_next => out = Some(PathBuf::from(argument)),
            None => others.push(PathBuf::from(text.split_once('=').map_or(&*text, |(_, value)| value))),
        }
        is_next = text == "--out";
    }
    out.filter(|out| others.iter().any(|other| is_same_file(out, other)))
}

/// Whether two paths, links followed, lead to one file.
fn is_same_file(one: &Path, other: &Path) -> bool {
    let file = |path: &Path| std::fs::canonicalize(path).ok().filter(|path| path.is_file());
    file(one).is_some_and(|one| file(other) == Some(one))
}

fn also_read(out: &Path) -> String {
    format!("--out {} is also an input file; choose another name", out.display())
}

/// Runs a command and returns its exit status.
pub(crate) fn run_command(command: Command) -> ExitCode {
    status(match command {
        Command::Verify(args) => verify::verify(&args),
        Command::Run(args) => run::run(&args),
        Command::Report(args) => report::report(&args),
        Command::Bounds(args) => bounds::bounds(&args),
        Command::Pulses(args) => pulses::pulses(&args),
        Command::Timing(args) => timing::timing(&args),
        Command::Spectrum(args) => spectrum::spectrum(&args),
        Command::Sweep(args) => sweep::sweep(&args),
        Command::Compare(args) => compare::compare(&args),
        Command::Fisher(args) => fisher::fisher(&args),
        Command::Fit(args) => fit::run(&args),
        Command::Forecast(args) => forecast::run(&args),
        Command::Limits(args) => limits::run(&args),
        Command::Figures(args) => figures::figures(&args),
        Command::Bench(args) => bench::bench(&args),
        Command::Scenes(args) => scenes::scenes(&args),
        Command::Equations => print(&equation_table::markdown()),
        Command::Stability(args) => print(&stability::table::markdown(args.rounds)),
        Command::Claims => claims::markdown().map_err(Failure::Failed).and_then(|page| print(&page)),
    })
}

fn status(result: Result<(), Failure>) -> ExitCode {
    let _ending = interrupt::hold_requests();
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure::Failed(message)) => end(1, &message),
        Err(Failure::BadInput(message)) => end(2, &message),
        Err(Failure::Partly(message)) => end(3, &message),
        Err(Failure::Interrupted(left)) => end(interrupt::INTERRUPTED, &format!("interrupted: {left}")),
    }
}

fn end(status: u8, message: &str) -> ExitCode {
    let _ = writeln!(io::stderr(), "error: {message}");
    ExitCode::from(status)
}

/// A line on standard error that is not an error.
fn note(text: &str) {
    let _ = writeln!(io::stderr(), "note: {text}");
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The commands that the help, README and the pages of `docs/` tell the reader to type.
    #[test]
    fn commands_of_the_documentation_are_understood() {
        let read = |path: &std::path::Path| std::fs::read_to_string(path).expect("a page");
        let root = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
        let pages = std::fs::read_dir(root.join("docs")).expect("the pages").map(|page| page.expect("a page").path());
        let pages: Vec<_> = pages.filter(|page| page.is_file()).chain([root.join("README.md")]).collect();
        let help = include_str!("../../data/examples.txt").lines().filter_map(|line| line.strip_prefix("  twofold "));
        let pages: Vec<String> = pages.iter().map(|page| read(page)).collect();
        let shown = pages.iter().flat_map(|page| page.lines()).filter_map(|line| {
            let line = line.trim_start();
            line.strip_prefix("$ twofold ").or_else(|| line.strip_prefix("cargo run --release -- "))
        });
        let mut count = 0;
        for line in help.chain(shown) {
            // Without remarks, redirections and the brackets of optional parts.
            let typed =
                ["  ", " >", " 2>", " |", " #"].iter().fold(line, |line, end| line.split(end).next().unwrap_or(line));
            let typed = typed.replace(['[', ']'], "");
            let parsed = Cli::try_parse_from(std::iter::once("twofold").chain(typed.split_whitespace()));
            assert!(parsed.is_ok(), "{line}");
            count += 1;
        }
        assert!(count > 50, "{count}");
    }
}

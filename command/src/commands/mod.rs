//! The command `twofold`: verify the paper's equations, run a scene, list the scenes, bounds from pulsars.

mod bench;
mod bounds;
mod compare;
mod explain;
mod figures;
mod fisher;
mod fit;
mod forecast;
mod fuzzed;
mod interrupt;
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

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

pub use fuzzed::fuzzed_arguments;

use clap::{Args, Parser, Subcommand};
use twofold::epoch::Epoch;

use standard_output::{print, tell};

use twofold_scene::sweep::Shard;
use twofold_verify::{claims, equation_table, stability};

/// The rotation of spheroidal stars under Lorentz violation, as verified equations
///
/// Without a command, `verify` is run.
#[derive(Parser)]
#[command(name = "twofold", version, max_term_width = 100, after_help = AFTER_HELP)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

const AFTER_HELP: &str = "\
Examples:
  twofold                           run every check of the paper's equations, print the table
  twofold verify --filter steady    only the checks whose name contains `steady`
  twofold run tp-1 > tp-1.csv       the paper's first example of twofold precession
  twofold scenes --print tp-2 > my-star.toml
                                    a scene to change into yours
  twofold run my-star.toml --out my-star.csv
  twofold bounds                    limits from the paper's table of pulsars
  twofold run tp-2 --columns h      only the gravitational wave
  twofold run tp-1 --columns h --explain
                                    the plan for it: method, what is skipped, cost
  twofold pulses tp-1               every pulse of the radio beam
  twofold spectrum tp-1 --of m.n --span 4000
                                    the spectral lines of the pulsar signal, identified
  twofold fisher tp-1 --observe arrivals:1e-4,widths:1e-4
                                    how well such pulses would tell the star and s
  twofold sweep grid.toml --out grid.csv
                                    a table with a row for each of many scenes; goes on where it was interrupted
  twofold timing b1937+21 --out timing
                                    arrival times over decades, as .csv, .par and .tim, and the strain
  twofold figures --out figures     the paper's figures and ours
  twofold report                    everything as one page, report/index.html

Exit status: 0 all well; 1 a check or a computation failed; 2 bad input, and nothing was written;
3 a sweep is complete but for scenes that failed; 130 interrupted.";

#[derive(Subcommand)]
enum Command {
    /// Run the checks of the paper's equations and print what each measured, its bound and the verdict
    ///
    /// A check compares an equation of the paper with something independent of it: exact arithmetic, automatic
    /// derivatives, another method, an invariant. It measures one figure, which must meet one bound.
    Verify(VerifyArgs),
    /// Compute the motion of a star, or what an observer sees of it, and write it as CSV
    ///
    /// The header of the table names the columns and their units. A scene in the paper's units has times in
    /// t_c = sqrt(I^xx / C), a scene of a physical star in seconds. Angles are in rad and continuous: they count their
    /// turns. Where the symmetry axis is exactly on a pole they do not exist, and their fields are empty.
    Run(RunArgs),
    /// Print the bounds on Lorentz violation from the pulse widths of pulsars, and one recommended limit with its confidence
    ///
    /// Without a file: the two pulsars of the paper's table, beside its numbers. Published limits stand below. The format of a
    /// table and the method are described in docs/bounds.md.
    Bounds(BoundsArgs),
    /// Find every pulse of a star's radio beam in the span of a scene and write them as CSV
    ///
    /// A pulse is a stretch of time in which the line of sight is inside the beam, m.n > cos(rho). The scene must have the
    /// sections [observer] and [pulsar]; the samples of its [time] do not matter, its span does. None is missed and none invented, but
    /// where an extremum of m.n is within 1e-13 of cos(rho): rounding decides there, and a note says when.
    Pulses(PulsesArgs),
    /// Compute arrival times of a pulsar over decades, and what they are late by against a constant frequency
    ///
    /// Writes SCENE.csv, SCENE.par and SCENE.tim (FORMAT 1, barycentre), and the strain at the beginning as SCENE.h_plus.txt and
    /// SCENE.h_cross.txt. Pulses are those nearest to the epochs asked for; without options, to the times of the scene. The motion is
    /// the averaged motion of second order (docs/averaged-solution.md), the files are described in docs/pulsars.md.
    Timing(TimingArgs),
    /// Find the spectral lines of what a scene gives, name them by the fundamental frequencies of the motion, write them as CSV
    ///
    /// The step of the series follows from the rotation rate, not from the scene's samples. Notes on standard error tell the
    /// step, the fundamental frequencies and the constant term.
    Spectrum(SpectrumArgs),
    /// Compute many scenes, grids, lists or random draws of the parameters of one, and write a table with a row for each
    ///
    /// The table grows in FILE.partial and gets its name when it is complete. Whatever ends the command before, the same command
    /// goes on where it was, and the table is the same to the byte as without the interruption. A scene that fails is a row
    /// that says so, and a line in FILE.errors.csv. The format of a sweep file is described in docs/sweep.md.
    Sweep(SweepArgs),
    /// Compare the data that the paper's authors published with the same numbers computed here
    ///
    /// The files are those of the folder `data3` of github.com/ryxxastroat/lorentz_precession. Each known one in the folder is
    /// read and computed anew; the largest difference of each column is printed beside what the file is known to be off by.
    Compare(CompareArgs),
    /// Draw the paper's figures and ours, each as SVG and PNG, with its caption and its data
    ///
    /// Writes NAME.svg, NAME.png, NAME.md and NAME.csv (or NAME.TABLE.csv) of each figure; the files appear when all are
    /// complete. With --scene the figures of a motion are drawn for a scene in place of the paper's examples.
    Figures(FiguresArgs),
    /// Tell how well measurements of a scene would determine its parameters, and what they cannot determine at all
    ///
    /// The Fisher matrix of pulse times, widths or strains with independent errors, by exact derivatives. Prints the standard
    /// deviation of each parameter with all others unknown; notes on standard error name every combination of parameters that
    /// the data leave open, with the reason where it is a symmetry. docs/inference.md describes parameters and method.
    Fisher(FisherArgs),
    /// Fit the parameters of a scene to measured series, by least squares, with error bars
    ///
    /// Data are tables of `twofold pulses` or of `twofold run --columns h`. The fit begins at the scene, which must be near enough
    /// that its pulses are those of the data. Parameters that the data do not determine are refused, with the reason.
    Fit(FitArgs),
    /// Tell how the uncertainty of one parameter goes with the span, the number and the errors of measurements
    Forecast(ForecastArgs),
    /// Time every method against its true error, and what comes on top of a motion
    ///
    /// Seven scenes of 1,000 t_c with references of 30 digits; methods are run in turn, and the least time of each counts. Then
    /// the growth of errors over long motions, what events, samples, gradients and wider numbers cost, and how the time goes
    /// with the number of outputs, scenes and cores.
    Bench(BenchArgs),
    /// List the built-in scenes and sweeps, or print the file of one
    Scenes(ScenesArgs),
    /// Run every check and write everything as one HTML page: claims, equations, checks, golden tables, figures
    ///
    /// The page is DIR/index.html. It needs no network, no script and no other file. It is written, and says so at its
    /// top, also where checks fail; the status is then 1.
    Report(ReportArgs),
    /// Print the table of equations: what implements each, which checks and golden numbers are about it (Markdown)
    Equations,
    /// Print the paper's statements, each with a verdict and what the checks behind it measured (Markdown)
    Claims,
    /// Print the tables of digits lost by every kernel, as Markdown
    #[command(hide = true)]
    Stability(StabilityArgs),
}

#[derive(Args)]
struct StabilityArgs {
    /// Rounds of points, 40 in each case and round as a rule
    #[arg(long, value_name = "COUNT", default_value_t = stability::table::ROUNDS)]
    rounds: u64,
}

#[derive(Args, Default)]
struct VerifyArgs {
    /// Only checks whose id contains this text, and what each of their figures is
    #[arg(long, value_name = "ID")]
    filter: Option<String>,
    /// Print the results as a JSON array instead of tables
    #[arg(long)]
    json: bool,
}

#[derive(Args)]
struct RunArgs {
    /// A built-in scene (see `twofold scenes`) or the path of a scene file (TOML)
    scene: String,
    /// Only these groups of columns, whatever the scene says: angles, rates, e_x, e_z, L, integrals, perturbation, lambda,
    /// m.n, magnetic_axis, position_angle, h
    #[arg(long, value_name = "GROUP,GROUP", value_delimiter = ',')]
    columns: Option<Vec<String>>,
    #[command(flatten)]
    plan: PlanArgs,
    #[command(flatten)]
    output: OutputArgs,
}

#[derive(Args)]
struct PulsesArgs {
    /// A built-in scene (see `twofold scenes`) or the path of a scene file (TOML)
    scene: String,
    /// The opposite beam too, whatever the scene says
    #[arg(long)]
    second_beam: bool,
    #[command(flatten)]
    plan: PlanArgs,
    #[command(flatten)]
    output: OutputArgs,
}

#[derive(Args)]
struct TimingArgs {
    /// A built-in scene (see `twofold scenes`) or the path of a scene file (TOML), with `time.epoch`, [observer] and [pulsar]
    scene: String,
    /// First epoch (MJD, TDB); if not given, that of the scene
    #[arg(long, value_name = "MJD", value_parser = timing::date)]
    from: Option<Epoch>,
    /// Last epoch; if not given, the end of the scene's span
    #[arg(long, value_name = "MJD", value_parser = timing::date)]
    to: Option<Epoch>,
    /// Days between epochs
    #[arg(long, value_name = "DAYS", conflicts_with = "epochs", allow_hyphen_values = true)]
    every: Option<f64>,
    /// Number of epochs, both ends included
    #[arg(long, value_name = "NUMBER")]
    epochs: Option<usize>,
    /// Fit F1 beside F0: what a spin-down absorbs is no signature
    #[arg(long)]
    f1: bool,
    /// Uncertainty of the arrival times that the .tim states, in microseconds
    #[arg(long, value_name = "US", default_value = "1", allow_hyphen_values = true)]
    uncertainty: f64,
    /// Length of the strain series in seconds, from the first epoch on; 64 turns if not given
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true)]
    strain_span: Option<f64>,
    /// Samples of strain in a second; a power of two if not given
    #[arg(long, value_name = "HZ", allow_hyphen_values = true)]
    strain_rate: Option<f64>,
    /// Folder for the files, made if it is not there
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
}

#[derive(Args)]
struct SpectrumArgs {
    /// A built-in scene (see `twofold scenes`) or the path of a scene file (TOML)
    scene: String,
    /// The column, by its name in the header of `twofold run`, without the unit: m.n, h_plus, cos_lambda, beta, ...
    #[arg(long, value_name = "COLUMN")]
    of: String,
    /// The lines, or the amplitudes at equally spaced frequencies by a Fourier transform
    #[arg(long, value_enum, default_value = "lines")]
    table: SpectrumTable,
    /// Length of the series in the scene's unit of time, instead of the scene's span
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    span: Option<f64>,
    /// Least amplitude of a line, as a part of the largest one
    #[arg(long, value_name = "RATIO", default_value = "1e-6")]
    least: f64,
    /// Most lines that are written, the strongest first
    #[arg(long, value_name = "NUMBER", default_value = "50", value_parser = clap::value_parser!(u8).range(1..=200))]
    most: u8,
    /// Do not name the lines, which asks for a longer span than to find them
    #[arg(long)]
    unidentified: bool,
    #[command(flatten)]
    plan: PlanArgs,
    #[command(flatten)]
    output: OutputArgs,
}

#[derive(Args)]
struct ScenesArgs {
    /// Print the file of this built-in scene or sweep, as a template: `twofold scenes --print tp-2 > my-star.toml`
    #[arg(long, value_name = "NAME")]
    print: Option<String>,
}

/// Which table of a spectrum.
#[derive(Clone, Copy, clap::ValueEnum)]
enum SpectrumTable {
    Lines,
    Spectrum,
}

#[derive(Args)]
struct SweepArgs {
    /// The sweep (TOML)
    file: String,
    /// The table: CSV, or Parquet if the name ends in .parquet
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Replace the table if it exists
    #[arg(long)]
    force: bool,
    /// Begin anew, whatever part of the table is there
    #[arg(long)]
    restart: bool,
    /// Compute only part i of n: consecutive scenes, so that the parts' tables one after the other are the whole
    #[arg(long, value_name = "I/N", conflicts_with = "merge")]
    shard: Option<Shard>,
    /// Number of threads; all cores if not given
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u16).range(1..=4096))]
    threads: Option<u16>,
    /// Compute nothing: write the CSV tables of all shards, in their order, as one table
    #[arg(long, value_name = "PART", num_args = 1..)]
    merge: Vec<PathBuf>,
}

#[derive(Args)]
struct CompareArgs {
    /// Folder with the authors' files: tp1.dat, mntp1.dat, ...
    #[arg(long, value_name = "DIR")]
    authors_data: PathBuf,
    /// Print the comparison as JSON instead of a table
    #[arg(long)]
    json: bool,
}

#[derive(Args)]
struct PlanArgs {
    /// Compute nothing: print the plan, what it skips and why, and what it is expected to cost
    #[arg(long)]
    explain: bool,
    /// The method, instead of the cheapest that meets the accuracy: free, steady, symmetric, mean, splitting, taylor
    #[arg(long, value_name = "NAME")]
    method: Option<String>,
}

#[derive(Args)]
struct TableArgs {
    /// Write the table, with every digit and all correlations, to this file as CSV too
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long, requires = "out")]
    force: bool,
}

#[derive(Args)]
struct OutputArgs {
    /// Write the table to this file instead of standard output; appears only when it is complete
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long, requires = "out")]
    force: bool,
}

#[derive(Args)]
struct MeasurementArgs {
    /// A built-in scene (see `twofold scenes`) or the path of a scene file (TOML)
    scene: String,
    /// What is measured, each with the standard deviation of its independent errors in the scene's unit: arrivals,
    /// closest_approaches, widths, periods (of pulses); h_plus, h_cross or strain for both (at the samples of the scene)
    #[arg(long, value_name = "NAME:SIGMA,NAME:SIGMA")]
    observe: String,
    /// What is not known: eps, spin, c, s_scale, s_axial, s_asymmetry, s_trace, s_xy, s_xz, s_yz, alpha, beta, gamma, alpha_rate,
    /// beta_rate, chi, delta, rho, theta_o, phi_o, strain_scale; or all. If not given, what such data can determine
    #[arg(long, value_name = "NAME,NAME")]
    parameters: Option<String>,
}

#[derive(Args)]
struct FisherArgs {
    #[command(flatten)]
    measurement: MeasurementArgs,
    #[command(flatten)]
    output: TableArgs,
}

#[derive(Args)]
struct FitArgs {
    #[command(flatten)]
    measurement: MeasurementArgs,
    /// Tables of `twofold pulses` or of `twofold run --columns h`, with the same unit and zero of time as the scene
    #[arg(value_name = "DATA")]
    data: Vec<String>,
    /// Add random errors of the sizes in --observe to the data; without DATA to those of the scene itself, and begin the fit
    /// beside it
    #[arg(long, value_name = "SEED")]
    simulate: Option<u64>,
    #[command(flatten)]
    output: TableArgs,
}

#[derive(Args)]
struct ForecastArgs {
    #[command(flatten)]
    fisher: FisherArgs,
    /// The parameter
    #[arg(long, value_name = "NAME", default_value = "s_axial")]
    of: String,
    /// Spans in the scene's unit of time; if not given, that of the scene and twice, four and eight times as much
    #[arg(long, value_name = "TIME,TIME", value_delimiter = ',', allow_hyphen_values = true)]
    spans: Option<Vec<f64>>,
    /// Numbers of epochs, equally spaced over the span, with one pulse and one sample of the strain each
    #[arg(long, value_name = "NUMBER,NUMBER", value_delimiter = ',', default_value = "25,50,100")]
    epochs: Vec<usize>,
}

#[derive(Args)]
struct ReportArgs {
    /// Write the page into this folder, which is made if need be
    #[arg(long, value_name = "DIR", default_value = "report")]
    out: PathBuf,
    /// Replace the page if it exists
    #[arg(long)]
    force: bool,
}

#[derive(Args)]
struct FiguresArgs {
    /// Figures to draw, by name or by number of the paper's figure; all if none is named
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// Folder for the files, made if it is not there
    #[arg(long, value_name = "DIR", default_value = "figures")]
    out: PathBuf,
    /// Draw the figures of a motion for this built-in scene or scene file (TOML)
    #[arg(long, value_name = "SCENE")]
    scene: Option<String>,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
    /// List the figures instead of drawing them
    #[arg(long)]
    list: bool,
}

#[derive(Args)]
struct BenchArgs {
    /// Some ten seconds instead of minutes: fewer repeats, and long motions to 1e4 t_c only
    #[arg(long)]
    quick: bool,
    /// Write the tables, every run as CSV and the work-precision plot into this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace files that exist
    #[arg(long, requires = "out")]
    force: bool,
}

#[derive(Args)]
struct BoundsArgs {
    /// A table of pulsars (TOML)
    file: Option<String>,
    /// Print the same as JSON
    #[arg(long)]
    json: bool,
}

/// How a command ends when it does not succeed.
enum Failure {
    /// A check or a computation failed: status 1.
    Failed(String),
    /// The input is not usable: status 2.
    BadInput(String),
    /// Everything is written, and some of it says that it could not be computed: status 3.
    Partly(String),
    /// Ended by a signal, with what is left: status 130.
    Interrupted(String),
}

/// Runs the command with the arguments of the process.
pub fn main() -> ExitCode {
    if let Err(error) = interrupt::watch() {
        return end(1, &format!("signals cannot be handled: {error}"));
    }
    match Cli::try_parse() {
        Ok(cli) => run_command(cli.command.unwrap_or(Command::Verify(VerifyArgs::default()))),
        Err(misuse) if misuse.use_stderr() => {
            let _ = misuse.print();
            ExitCode::from(2)
        }
        Err(help_or_version) => status(print(&help_or_version.render().to_string())),
    }
}

fn run_command(command: Command) -> ExitCode {
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
        Command::Figures(args) => figures::figures(&args),
        Command::Bench(args) => bench::bench(&args),
        Command::Scenes(args) => scenes::scenes(&args),
        Command::Equations => print(&equation_table::markdown()),
        Command::Stability(args) => print(&stability::table::markdown(args.rounds)),
        Command::Claims => claims::markdown().map_err(Failure::Failed).and_then(|page| print(&page)),
    })
}

fn status(result: Result<(), Failure>) -> ExitCode {
    let _ending = interrupt::no_more_requests();
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

/// A line on standard error that is no error.
fn note(text: &str) {
    let _ = writeln!(io::stderr(), "note: {text}");
}

//! The arguments of `twofold fisher`, `fit` and `forecast`.

use std::path::PathBuf;

use clap::Args;

#[derive(Args)]
pub(crate) struct MeasurementArgs {
    /// A built-in scene (see `twofold scenes`) or the path of a scene file (TOML)
    pub(crate) scene: String,
    /// The observables, each with the standard deviation of its independent errors in the scene's unit: arrivals,
    /// closest_approaches, widths, periods (of pulses); h_plus, h_cross or strain for both (at the samples of the scene)
    #[arg(long, value_name = "NAME:SIGMA,NAME:SIGMA")]
    pub(crate) observe: String,
    /// Unknown parameters: eps, spin, c, s_scale, s_axial, s_asymmetry, s_trace, s_xy, s_xz, s_yz, alpha, beta, gamma, alpha_rate,
    /// beta_rate, chi, delta, rho, theta_o, phi_o, strain_scale; or all. If not given, those that such data can determine
    #[arg(long, value_name = "NAME,NAME")]
    pub(crate) parameters: Option<String>,
}

#[derive(Args)]
pub(crate) struct TableArgs {
    /// Also write the table to this file as CSV, with every digit and, of error bars, all correlations
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
}

#[derive(Args)]
pub(crate) struct FisherArgs {
    #[command(flatten)]
    pub(crate) measurement: MeasurementArgs,
    #[command(flatten)]
    pub(crate) output: TableArgs,
}

#[derive(Args)]
pub(crate) struct FitArgs {
    #[command(flatten)]
    pub(crate) measurement: MeasurementArgs,
    /// Tables of `twofold pulses` or of `twofold run --columns h`, with the same unit and zero of time as the scene
    #[arg(value_name = "DATA")]
    pub(crate) data: Vec<String>,
    /// Add random errors of the sizes in --observe to the data; without DATA, simulate the data from the scene, and start the fit
    /// three standard deviations away from it
    #[arg(long, value_name = "SEED")]
    pub(crate) simulate: Option<u64>,
    #[command(flatten)]
    pub(crate) output: TableArgs,
}

#[derive(Args)]
pub(crate) struct ForecastArgs {
    #[command(flatten)]
    pub(crate) fisher: FisherArgs,
    /// The parameter whose uncertainty is forecast
    #[arg(long, value_name = "NAME", default_value = "s_axial")]
    pub(crate) of: String,
    /// Spans in the scene's unit of time; if not given, 1, 2, 4 and 8 times that of the scene
    #[arg(long, value_name = "TIME,TIME", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) spans: Option<Vec<f64>>,
    /// Numbers of epochs, equally spaced over the span, with one pulse and one sample of the strain each
    #[arg(long, value_name = "NUMBER,NUMBER", value_delimiter = ',', default_value = "25,50,100")]
    pub(crate) epochs: Vec<usize>,
}

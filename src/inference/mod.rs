//! From data back to the star and to s: what pulse times, widths and strains tell of the parameters of a scene.
//!
//! ```text
//! scene -> Model (a number for each Unknown) -> Signal (one motion) -> values of Data, and their Jacobian by exact derivatives
//!       -> Fisher: uncertainties, degenerate Directions, named        -> forecasts
//!       -> fit: least squares from a start, covariance by the Jacobian at the solution
//! ```
//!
//! The formulas, what is promised and the coverage of the error bars are in `docs/inference.md`.

mod coverage;
mod data_file;
mod degenerate;
mod error;
mod fisher;
mod fit;
mod forecast;
mod jacobian;
mod long_span;
mod model;
mod observables;
mod signal;
mod simulate;
mod symmetry;
mod unknown;

pub use coverage::{Case, Coverage, Score};
pub use data_file::DataFile;
pub use degenerate::Direction;
pub use error::InferenceError;
pub use fisher::Fisher;
pub use fit::{Fit, Residuals, fit, nonlinearity};
pub use forecast::{Forecast, forecast, scaling};
pub use jacobian::{Jacobian, jacobian};
pub use long_span::check_span;
pub use model::Model;
pub use observables::{Datum, Noise, Observable, Place, data_of, parse_noise};
pub use signal::{Event, Signal};
pub use simulate::{Campaign, Simulation, beside, with_noise};
pub use unknown::Unknown;

//! `twofold fit`.

use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use super::measurement::{Measurement, note_nonlinearity, readable, uncertainties, write_csv};
use super::{Failure, FitArgs, counted, note, print};
use twofold::inference::{Fisher, InferenceError, Residuals, fit, nonlinearity};
use twofold_scene::measurements::{DataFile, LeftOut, beside, with_noise};
use twofold_scene::significant::significant;

pub(super) fn run(args: &FitArgs) -> Result<(), Failure> {
    let measurement = Measurement::read(&args.measurement)?;
    let refused = |error: InferenceError| match error {
        InferenceError::TooFew { .. } if !args.data.is_empty() => {
            Failure::BadInput(format!("{}: {error}", args.data.join(", ")))
        }
        error => measurement.refused(error),
    };
    let (parameters, unknowns, end) = (&measurement.parameters, &measurement.unknowns, measurement.end);
    let signal = measurement.signal()?;
    let mut data = match (args.data.as_slice(), args.simulate) {
        ([], None) => {
            return Err(Failure::BadInput(format!(
                "{}: no data; give files of data, or --simulate SEED, or both",
                measurement.name
            )));
        }
        ([], Some(_)) => measurement.simulated(&signal).map_err(|error| refused(error.into()))?,
        (files, _) => {
            let tables = files.iter().map(|file| DataFile::read(file)).collect::<Result<Vec<_>, _>>();
            let found = tables.and_then(|tables| measurement.data_in(&tables, &signal));
            let (data, left_out) = found.map_err(Failure::BadInput)?;
            let LeftOut { first_turn, shared_turns } = left_out;
            if first_turn > 0 {
                note(&format!(
                    "left out {first_turn} of the data, because the pulse of the first turn may be cut in another model"
                ));
            }
            if shared_turns > 0 {
                note(&format!("left out {shared_turns} of the pulses, because they share a turn with another"));
            }
            data
        }
    };
    let mut start = *parameters;
    if let Some(seed) = args.simulate {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        data = with_noise(&data, &mut random);
        if args.data.is_empty() {
            let events = measurement.events(&signal).map_err(|error| refused(error.into()))?;
            let fisher = Fisher::of(parameters, &events, &data, unknowns).and_then(Fisher::determined);
            start = beside(&fisher.map_err(refused)?, 3.0, &mut random)?;
            note("simulated data: the fit starts three standard deviations away from the scene");
        }
    }
    let found = fit(&start, &data, unknowns, end).map_err(refused)?;
    let [short, all] = uncertainties(&found.fisher, |unknown| measurement.unit(unknown));
    write_csv(&args.output, &all)?;
    note(&format!(
        "{} data, {}, {}; chi^2 = {} of {} of freedom",
        data.len(),
        counted(unknowns.len(), "unknown"),
        counted(found.iterations, "step"),
        significant(found.chi_squared, 4),
        counted(found.degrees, "degree")
    ));
    let size = significant(found.root_mean_square(), 2);
    match found.consistency() {
        Residuals::Consistent => {}
        Residuals::Larger => note(&format!(
            "the residuals are {size} times the errors of --observe (root mean square): the scene does not describe the data, or their errors \
             are larger; the error bars hold for the errors stated"
        )),
        Residuals::Smaller => note(&format!(
            "the residuals are {size} times the errors of --observe (root mean square): the scene fits the data better than such errors allow, \
             as it does for data without errors; the error bars hold for the errors stated"
        )),
    }
    note_nonlinearity(nonlinearity(&found.fisher, &data, end));
    print(&readable(&short))
}

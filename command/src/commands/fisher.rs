//! `twofold fisher`.

use super::measurement::{Measurement, readable, uncertainties, write_csv};
use super::{Failure, FisherArgs, note, print};
use twofold::inference::{Direction, Fisher, InferenceError, Observable, data_of};

pub(super) fn fisher(args: &FisherArgs) -> Result<(), Failure> {
    let measurement = Measurement::read(&args.measurement)?;
    let refused = |error: InferenceError| measurement.refused(error);
    let signal = measurement.signal()?;
    let events = measurement.events(&signal).map_err(|error| refused(error.into()))?;
    let data =
        data_of(&signal, &events, &measurement.samples(), &measurement.noise).map_err(|error| refused(error.into()))?;
    let fisher = Fisher::of(&measurement.parameters, &events, &data, &measurement.unknowns).map_err(refused)?;
    let [short, all] = uncertainties(&fisher, |unknown| measurement.unit(unknown));
    write_csv(&args.output, &all)?;
    let counts: Vec<_> = Observable::ALL
        .iter()
        .map(|kind| (kind.key(), data.iter().filter(|datum| datum.observable == *kind).count()))
        .filter(|(_, count)| *count > 0)
        .map(|(key, count)| format!("{count} {key}"))
        .collect();
    note(&counts.join(", "));
    let values = &fisher.singular_values;
    if let (Some(largest), Some(smallest)) = (values.first(), values.last()) {
        note(&format!(
            "singular values of the scaled Jacobian from {largest:.1e} to {smallest:.1e}; rounding turns a zero into at most {:.1e}",
            fisher.rounding
        ));
    }
    let in_units = |direction: &Direction| {
        let change = direction.change.iter().map(|(unknown, size)| (*unknown, size * measurement.unit(*unknown).0));
        Direction { change: change.collect(), ..direction.clone() }
    };
    for direction in fisher.degenerate.iter().map(in_units) {
        note(&format!("not determined: {direction}"));
    }
    for direction in fisher.weak.iter().map(in_units) {
        note(&format!("less than one standard deviation over the whole range: {direction}"));
    }
    print(&readable(&short))
}

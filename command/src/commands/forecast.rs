//! `twofold forecast`.

use super::measurement::{Measurement, readable, write_csv};
use super::{Failure, FisherArgs, ForecastArgs, counted, note, print};
use twofold::inference::{ALLOWED_IN_FORECASTS, Observable, check_span, forecast, scaling, time_for_a_pulse};
use twofold::parameters::Parameter;
use twofold_scene::estimated_error::as_printed;
use twofold_scene::significant::significant;

pub(super) fn run(args: &ForecastArgs) -> Result<(), Failure> {
    let FisherArgs { measurement, output } = &args.fisher;
    let measurement = Measurement::read(measurement)?;
    let refuse = |why: String| Failure::BadInput(format!("{}: {why}", measurement.name));
    let named = Parameter::FITTED.into_iter().find(|parameter| parameter.key() == args.of);
    let target = named.filter(|target| measurement.unknowns.contains(target)).ok_or_else(|| {
        let keys: Vec<_> = measurement.unknowns.iter().map(|unknown| unknown.key()).collect();
        let keys = keys.join(", ");
        let of = named.map_or(String::new(), |target| format!("; add {} to --parameters to use it", target.key()));
        refuse(format!("--of {}: must be one of the unknown parameters, {keys}{of}", args.of))
    })?;
    if measurement.noise.iter().any(|(observable, _)| *observable == Observable::Periods) {
        return Err(refuse(format!("--observe periods: {ALLOWED_IN_FORECASTS}")));
    }
    let (unit, time) = (measurement.scene.units.time, measurement.scene.units.time_name);
    let spans = match &args.spans {
        Some(spans) => spans.clone(),
        None => {
            // To the digits that are printed.
            let span: f64 = format!("{:.11e}", measurement.end * unit).parse().expect("a number");
            (0..4).map(|k| span * f64::from(1 << k)).collect()
        }
    };
    for &span in &spans {
        if !(span > 0.0 && span.is_finite()) {
            return Err(refuse(format!("--spans {span:?}: must be a number above zero")));
        }
        if measurement.sees_pulses() {
            let least = time_for_a_pulse(&measurement.parameters);
            if span / unit <= least {
                return Err(refuse(if least.is_finite() {
                    let least = significant(least * unit, 3);
                    format!("--spans {span:?}: must be above 2.2 turns for pulses, {least} {time}")
                } else {
                    "the star is at rest at the start; only forecasts of strains are possible".to_owned()
                }));
            }
            check_span(&measurement.parameters, span / unit)
                .map_err(|why| refuse(format!("--spans {span:?}: {why}")))?;
        }
    }
    if let Some(count) = args.epochs.iter().find(|count| !(2..=100_000).contains(*count)) {
        return Err(refuse(format!("--epochs {count}: must be from 2 to 100000")));
    }
    let in_tc: Vec<f64> = spans.iter().map(|span| span / unit).collect();
    let (noise, unknowns) = (&measurement.noise, &measurement.unknowns);
    let found = forecast(&measurement.parameters, noise, unknowns, target, &in_tc, &args.epochs)
        .map_err(|error| measurement.refused(error))?;
    let (factor, target_unit) = measurement.unit(target);
    let header = [
        format!("span [{time}]"),
        "epochs".to_owned(),
        "data of each".to_owned(),
        format!("sigma_{} [{target_unit}]", target.key()),
    ];
    let [mut rows, mut all] = [vec![header.to_vec()], vec![header.to_vec()]];
    for (row, forecast) in found.iter().enumerate() {
        let sigma = forecast.sigma * factor;
        let [short, sigma] = [format!("{sigma:.6e}"), format!("{sigma:e}")]
            .map(|digits| if sigma.is_finite() { digits } else { String::new() });
        let cells =
            [format!("{:?}", spans[row / args.epochs.len()]), forecast.epochs.to_string(), forecast.data.to_string()];
        rows.push([&cells[..], &[short]].concat());
        all.push([&cells[..], &[sigma]].concat());
    }
    write_csv(output, &all)?;
    let unknown = found.iter().filter(|forecast| !forecast.sigma.is_finite()).count();
    if unknown > 0 {
        note(&format!(
            "no sigma in {unknown} of {}: the data are too few or do not determine {}; longer spans or more epochs may help",
            counted(found.len(), "row"),
            target.key()
        ));
    }
    let [by_span, by_epochs] = scaling(&found);
    for (what, slope) in [("span", by_span), ("number of data", by_epochs)] {
        if let Some(slope) = slope {
            let error = as_printed(slope.error, 0.5e-3);
            note(&format!("sigma scales as the {what} to the power of {:.3} +- {error:.3}", slope.value));
        }
    }
    note("sigma is proportional to the errors of the data");
    print(&readable(&rows))
}

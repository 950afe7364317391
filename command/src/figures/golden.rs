//! The data of the figures: a few numbers of each, out of the tables that the pictures are drawn from.

use std::collections::BTreeMap;

use twofold_verify::golden::{self, GoldenLine, GoldenTable, Printed};

use super::{Figure, Table};

/// Which number of a column.
#[derive(Clone, Copy)]
enum Pick {
    /// That of the row whose first column is nearest to this value.
    At(f64),
    /// That of the row whose first two columns are this and, in size, nearest to that.
    Of(f64, f64),
    /// That of the row with this place.
    Row(usize),
    First,
    Last,
    Least,
    Most,
}

use Pick::{At, First, Last, Least, Most, Of, Row};

/// Numbers of one column of a table, columns counted from zero.
type Numbers = (&'static str, usize, &'static [Pick]);

/// The numbers of each figure; the second name is that of the snapshot.
const NUMBERS: &[(&str, &str, &[Numbers])] = &[
    ("euler-angles", "figure_euler_angles", GEOMETRY),
    ("motion-tp-1", "figure_motion_tp_1", TWOFOLD),
    ("motion-tp-2", "figure_motion_tp_2", TWOFOLD),
    ("motion-sp-1", "figure_motion_sp_1", SINGLE),
    ("motion-sp-2", "figure_motion_sp_2", SINGLE),
    ("euler-angles-yzx", "figure_euler_angles_yzx", GEOMETRY),
    ("beam-cone", "figure_beam_cone", &[("", 0, &[First, Last]), ("", 1, &[First, Last])]),
    (
        "beam-alignment",
        "figure_beam_alignment",
        &[
            ("tp-I", 1, &[First, At(50.0), At(100.0), Last, Least, Most]),
            ("tp-II", 1, &[First, At(50.0), At(100.0), Last, Least, Most]),
        ],
    ),
    (
        "beam-alignment-spectra",
        "figure_beam_alignment_spectra",
        &[
            ("tp-I-lines", 0, &[Row(0), Row(1), Row(2), Row(3)]),
            ("tp-I-lines", 1, &[Row(0), Row(1), Row(2), Row(3)]),
            ("tp-II-lines", 0, &[Row(0), Row(1), Row(2), Row(3), Row(4)]),
            ("tp-II-lines", 1, &[Row(0), Row(1), Row(2)]),
        ],
    ),
    (
        "pulse-series",
        "figure_pulse_series",
        &[
            ("tp-I-periods", 1, &[First, Last, Least, Most]),
            ("tp-I-lengths", 1, &[First, Last]),
            ("tp-I-curves", 1, &[At(200.0)]),
            ("tp-I-curves", 2, &[At(200.0)]),
            ("tp-I-curves", 3, &[At(200.0)]),
            ("tp-I-curves", 4, &[At(200.0)]),
            ("tp-I-curves", 5, &[At(200.0)]),
            ("tp-I-curves", 6, &[At(200.0)]),
            ("tp-II-periods", 1, &[First, Last, Most]),
            ("tp-II-gaps", 1, &[First, Last, Least]),
            ("tp-II-lengths", 1, &[First, Last, Most]),
        ],
    ),
    (
        "waves",
        "figure_waves",
        &[
            ("tp-I", 1, &[First, At(50.0), Last, Most]),
            ("tp-I", 2, &[At(50.0), Last, Most]),
            ("tp-II", 1, &[First, At(50.0), Last, Most]),
            ("tp-II", 2, &[At(50.0), Last, Most]),
        ],
    ),
    (
        "wave-spectra",
        "figure_wave_spectra",
        &[
            ("tp-I-plus-lines", 0, &[Row(0), Row(1), Row(2)]),
            ("tp-I-plus-lines", 1, &[Row(0), Row(1), Row(2)]),
            ("tp-I-cross-lines", 1, &[Row(0), Row(1), Row(2)]),
            ("tp-II-plus-lines", 0, &[Row(0), Row(1), Row(7)]),
            ("tp-II-plus-lines", 1, &[Row(0), Row(1), Row(7)]),
        ],
    ),
    (
        "bound-factor",
        "figure_bound_factor",
        &[
            ("", 1, &[At(0.2), At(1.1), At(1.4)]),
            ("", 2, &[At(0.2), At(1.1), At(1.4), Last]),
            ("", 3, &[At(0.7), Least]),
            ("", 4, &[At(0.7), Least]),
            ("", 5, &[At(0.7), Least]),
        ],
    ),
    (
        "perturbation-regimes",
        "figure_perturbation_regimes",
        &[
            ("twofold-printed", 2, &[Of(0.2, 1e-3), Of(0.7, 1e-4), Of(0.7, 1e-2), Of(0.7, 0.4), Of(1.4, 1e-2)]),
            ("twofold-corrected", 2, &[Of(0.2, 1e-3), Of(0.7, 1e-4), Of(0.7, 1e-2), Of(0.7, 0.4), Of(1.4, 1e-2)]),
            ("single-printed", 2, &[Of(0.2, 0.09), Of(0.7, 0.01), Of(0.7, 0.09), Of(0.7, 0.5), Of(1.4, 0.09)]),
            ("single-corrected", 2, &[Of(0.2, 0.09), Of(0.7, 0.01), Of(0.7, 0.09), Of(0.7, 0.5), Of(1.4, 0.09)]),
        ],
    ),
    (
        "method-regimes",
        "figure_method_regimes",
        &[
            ("near-axis", 2, REGIMES),
            ("near-axis", 3, REGIMES),
            ("near-axis", 4, REGIMES),
            ("near-axis", 5, REGIMES),
            ("near-axis", 6, REGIMES),
            ("near-axis", 7, REGIMES),
            ("tilted", 2, REGIMES),
            ("tilted", 3, REGIMES),
            ("tilted", 4, REGIMES),
            ("tilted", 5, REGIMES),
            ("tilted", 6, REGIMES),
            ("tilted", 7, REGIMES),
            ("single", 2, REGIMES),
            ("single", 3, REGIMES),
            ("single", 4, REGIMES),
            ("single", 5, REGIMES),
            ("single", 6, REGIMES),
            ("single", 7, REGIMES),
            ("near-separatrix", 2, REGIMES),
            ("near-separatrix", 3, REGIMES),
            ("near-separatrix", 4, REGIMES),
            ("near-separatrix", 5, REGIMES),
        ],
    ),
    (
        "momentum-sphere",
        "figure_momentum_sphere",
        &[
            ("", 3, &[Least]),
            ("", 4, &[Least, Most]),
            ("", 7, &[Least]),
            ("", 8, &[Least, Most]),
            ("", 11, &[Least]),
            ("", 12, &[Least, Most]),
            ("", 15, &[Least]),
            ("", 16, &[Least, Most]),
            ("", 18, &[Least]),
            ("", 20, &[Least, Most]),
        ],
    ),
];

const REGIMES: &[Pick] = &[Of(1e-4, 10.0), Of(1e-3, 10.0), Of(1e-3, 1000.0), Of(1e-2, 100.0)];

const GEOMETRY: &[Numbers] = &[("", 0, &[First, Last]), ("", 1, &[First, Last]), ("", 2, &[First, Last])];

const TWOFOLD: &[Numbers] = &[
    ("angles", 1, &[First, Last]),
    ("angles", 2, &[First, At(15.0), Last]),
    ("angles", 3, &[Last]),
    ("angles", 4, &[At(15.0), Last]),
    ("angles", 5, &[Last]),
    ("angles", 6, &[At(15.0), Last]),
    ("paths", 1, &[At(15.0)]),
    ("paths", 4, &[At(15.0)]),
];

const SINGLE: &[Numbers] = &[
    ("angles", 1, &[First, At(100.0), Last]),
    ("angles", 2, &[First, At(100.0), Last]),
    ("angles", 3, &[At(100.0), Last]),
    ("angles", 4, &[At(100.0), Last]),
    ("paths", 1, &[At(40.0)]),
    ("paths", 4, &[At(100.0)]),
];

/// All golden tables: those of the verification, then those of `figures`, which must be all.
pub fn golden_tables(figures: &[Figure]) -> Result<Vec<GoldenTable>, String> {
    let mut tables = golden::tables()?;
    tables.extend(tables_of(figures)?);
    Ok(tables)
}

fn tables_of(figures: &[Figure]) -> Result<Vec<GoldenTable>, String> {
    let all: BTreeMap<&str, &Figure> = figures.iter().map(|figure| (figure.name.as_str(), figure)).collect();
    if let Some(missing) = all.keys().find(|name| !NUMBERS.iter().any(|(figure, ..)| figure == *name)) {
        return Err(format!("the figure {missing} has no golden numbers"));
    }
    NUMBERS.iter().map(|(name, snapshot, numbers)| table(&all, name, snapshot, numbers)).collect()
}

fn table(
    all: &BTreeMap<&str, &Figure>,
    name: &str,
    snapshot: &'static str,
    numbers: &[Numbers],
) -> Result<GoldenTable, String> {
    let figure = all.get(name).ok_or(format!("there is no figure {name}"))?;
    let mut lines = Vec::new();
    for (table, column, picks) in numbers {
        let found = figure.tables.iter().find(|found| found.name == *table);
        let table = found.ok_or(format!("{name} has no table {table}"))?;
        for pick in *picks {
            lines.push(line(table, *column, *pick).ok_or(format!("{name}: {} is empty", table.name))?);
        }
    }
    // Errors of approximations to three digits, as in the tables of regimes; lines, which are fitted, to six.
    let digits = match name {
        "perturbation-regimes" | "method-regimes" => 3,
        "beam-alignment-spectra" | "wave-spectra" => 6,
        _ => 9,
    };
    lines.iter_mut().for_each(|line| line.digits = digits);
    Ok(GoldenTable { name: snapshot, title: figure_title(figure), lines })
}

fn figure_title(figure: &Figure) -> &'static str {
    let recipe = super::RECIPES.iter().find(|recipe| recipe.name == figure.name);
    recipe.map_or("", |recipe| recipe.summary)
}

fn line(table: &Table, column: usize, pick: Pick) -> Option<GoldenLine> {
    let nearest =
        |distance: &dyn Fn(&Vec<f64>) -> f64| table.rows.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let by_value = |a: &&Vec<f64>, b: &&Vec<f64>| a[column].total_cmp(&b[column]);
    let row = match pick {
        Row(place) => table.rows.get(place),
        First => table.rows.first(),
        Last => table.rows.last(),
        Least => table.rows.iter().min_by(by_value),
        Most => table.rows.iter().max_by(by_value),
        At(value) => nearest(&|row| (row[0] - value).abs()),
        Of(first, second) => nearest(&|row| (row[0] - first).abs() + (row[1] / second).ln().abs()),
    }?;
    let place = match pick {
        Least => "least".to_owned(),
        Most => "largest".to_owned(),
        Of(..) => format!("at {:.4}, {:.4e}", row[0], row[1]),
        _ if table.columns[0].starts_with("beta_0") => format!("at {:.4}", row[0]),
        // A table of vectors has no time.
        _ if table.columns[0].starts_with("t [") => format!("at t = {:.3}", row[0]),
        Row(place) => format!("of line {}", place + 1),
        First => "first".to_owned(),
        _ => "last".to_owned(),
    };
    let name = if table.name.is_empty() { String::new() } else { format!("{}: ", table.name) };
    Some(GoldenLine::new(format!("{name}{} {place}", table.columns[column]), Printed::No, row[column]))
}

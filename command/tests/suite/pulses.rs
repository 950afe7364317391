//! `twofold pulses`: turns and closest approaches.

use crate::common::{Folder, cells, stderr, stdout, succeeds};

#[test]
fn pulses_have_turns_and_closest_approaches_where_turns_can_be_counted() {
    let text = stdout(&succeeds(&["pulses", "sp-2"]));
    let rows = &cells(&text)[1..];
    let whole: Vec<_> = rows.iter().filter(|row| row[6].is_empty()).collect();
    assert_eq!(whole[0][8], "0", "{text}");
    for row in rows {
        assert_eq!((row[8].is_empty(), row[9].is_empty()), (!row[6].is_empty(), !row[6].is_empty()), "{row:?}");
    }
    for pair in whole.windows(2) {
        let turn = |row: &[&str]| row[8].parse::<i64>().expect("turn");
        assert!(turn(pair[0]) < turn(pair[1]));
    }
    for row in &whole {
        let at = |k: usize| row[k].parse::<f64>().expect("number");
        assert!(at(2) < at(9) && at(9) < at(3), "{row:?}");
    }
    // Free precession, seen along the angular momentum.
    let rate = 1.1 / 0.7_f64.cos();
    let text = format!(
        "[star]\ninertia_ratio = 1.1\nspin = 1.0\n[lorentz_violation]\neigenvalues = [0.0, 0.0, 0.0]\n[initial]\nalpha = 0.0\n\
         beta = 0.7\nalpha_rate = {rate:?}\nbeta_rate = 0.0\n[observer]\ntheta_o = 0.0\nphi_o = 0.0\n[pulsar]\nchi = 0.5\n\
         rho = 0.6\n[time]\nspan = 300.0\nsamples = 3\n"
    );
    let output = Folder::with(&[("along.toml", &text)]).succeeds(&["pulses", "along.toml"]);
    let table = stdout(&output);
    assert_eq!(table.lines().count(), 6, "{table}");
    assert!(table.lines().skip(1).all(|line| line.ends_with(",,,")), "{table}");
    assert_eq!(
        stderr(&output).matches("note: turn and closest_approach are empty for 4 whole pulses of beam 1").count(),
        1
    );
}

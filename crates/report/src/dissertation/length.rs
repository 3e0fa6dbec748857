//! Lengths as text.

/// Returns a length (m) in mm, without the unit: three decimals below 1 mm, one above.
pub fn mm(metres: f64) -> String {
    let mm = 1e3 * metres;
    match mm.abs() {
        size if size < 0.0005 => "0.000".into(),
        size if size < 1.0 => format!("{mm:.3}"),
        _ => format!("{mm:.1}"),
    }
}

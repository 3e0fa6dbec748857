//! Parser of `--camera`.

use glam::Vec3;
use teeter_render::View;

/// Parses a view: `auto`, or azimuth and elevation (degrees), then distance and target (m), all or
/// the first of them.
pub fn parse(text: &str) -> Result<View, String> {
    if text == "auto" {
        return Ok(View::default());
    }
    let numbers: Option<Vec<f32>> =
        text.split(',').map(|part| part.trim().parse().ok().filter(|x: &f32| x.is_finite())).collect();
    let expected = "expected auto, or AZIMUTH,ELEVATION[,DISTANCE[,X,Y,Z]] in degrees and metres";
    let numbers = numbers.filter(|list| matches!(list.len(), 2 | 3 | 6)).ok_or(expected)?;
    within("the azimuth", numbers[0], [-360.0, 360.0], "degrees")?;
    within("the elevation", numbers[1], [1.0, 89.0], "degrees")?;
    if let Some(&distance) = numbers.get(2) {
        within("the distance", distance, [0.02, 1000.0], "m")?;
    }
    for &x in numbers.get(3..).unwrap_or_default() {
        within("the target", x, [-1000.0, 1000.0], "m")?;
    }
    Ok(View {
        azimuth: Some(numbers[0].to_radians()),
        elevation: Some(numbers[1].to_radians()),
        distance: numbers.get(2).copied(),
        target: numbers.get(3..6).map(Vec3::from_slice),
    })
}

fn within(name: &str, x: f32, [low, high]: [f32; 2], unit: &str) -> Result<(), String> {
    if (low..=high).contains(&x) { Ok(()) } else { Err(format!("{name} is {x}, expected {low} to {high} {unit}")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_view_has_all_or_the_first_parts() {
        assert_eq!(parse("auto"), Ok(View::default()));
        let view = parse("-90, 30").unwrap();
        assert_eq!((view.azimuth.map(f32::to_degrees), view.distance, view.target), (Some(-90.0), None, None));
        assert_eq!(parse("0,30,0.5").unwrap().distance, Some(0.5));
        assert_eq!(parse("0,30,0.5,0.1,-0.2,0.3").unwrap().target, Some(Vec3::new(0.1, -0.2, 0.3)));
    }

    #[test]
    fn a_view_that_is_none_is_refused() {
        for (text, cause) in [
            ("", "expected auto"),
            ("left", "expected auto"),
            ("1", "expected auto"),
            ("1,2,3,4", "expected auto"),
            ("1,NaN", "expected auto"),
            ("0,90", "the elevation is 90"),
            ("0,30,0", "the distance is 0"),
            ("0,30,1,0,0,1e9", "the target is"),
        ] {
            let error = parse(text).unwrap_err();
            assert!(error.contains(cause), "{text}: {error}");
        }
    }
}

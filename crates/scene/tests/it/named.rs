//! List of scenes: valid scenes, unique names, and the dissertation's configurations.

use teeter_scene::{NAMED, Scene, Stability, named};

#[test]
fn every_scene_is_valid_and_has_a_unique_name() {
    for entry in NAMED {
        let scene = entry.scene();
        assert_eq!(scene.validate(), Ok(()), "{}", entry.name);
        assert_eq!(scene.name, entry.name);
        assert_eq!(scene.label, entry.expect.map(|v| v.to_string()));
        assert_eq!(Scene::from_json(&scene.to_json()).unwrap(), scene);
        assert_eq!(NAMED.iter().filter(|n| n.name == entry.name).count(), 1, "{} is in the list twice", entry.name);
        assert!(!entry.title.is_empty() && !entry.title.contains('\n'));
    }
    assert_eq!(named("no such scene"), None);
}

#[test]
fn the_dissertation_tests_have_their_blocks() {
    let counts: Vec<usize> = (1..=6).map(|i| named(&format!("test-{i}")).unwrap().blocks.len()).collect();
    assert_eq!(counts, [6, 3, 4, 3, 4, 6]);
    assert_eq!(named("tower").unwrap().blocks.len(), 54);
    assert_eq!(named("loose").unwrap().blocks.len(), 18);
}

/// The blocks above a row must have their centre of mass over that row.
///
/// The condition is exact for towers whose rows carry on one block or on a span: necessary for the
/// stable ones and, where it fails, sufficient for the unstable ones.
#[test]
fn stability_agrees_with_centres_of_mass() {
    for entry in NAMED.iter().filter(|n| n.name.starts_with("test-")) {
        let scene = entry.scene();
        let mut margin = f64::INFINITY;
        let mut levels: Vec<f64> = scene.blocks.iter().map(|b| b.pos[2]).collect();
        levels.sort_by(f64::total_cmp);
        levels.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
        for level in &levels[..levels.len() - 1] {
            let (row, above): (Vec<_>, Vec<_>) =
                scene.blocks.iter().filter(|b| b.pos[2] > level - 1e-6).partition(|b| b.pos[2] < level + 1e-6);
            // Across the long axis of the row, which spans its outermost edges.
            let across = usize::from(row[0].yaw == 0.0);
            let mass: f64 = above.iter().map(|b| b.mass).sum();
            let centre = above.iter().map(|b| b.mass * b.pos[across]).sum::<f64>() / mass;
            let min = row.iter().map(|b| b.pos[across] - b.size[1] / 2.0).fold(f64::INFINITY, f64::min);
            let max = row.iter().map(|b| b.pos[across] + b.size[1] / 2.0).fold(f64::NEG_INFINITY, f64::max);
            margin = margin.min(centre - min).min(max - centre);
        }
        let stands = if margin > 0.0 { Stability::Stable } else { Stability::Unstable };
        assert_eq!(Some(stands), entry.expect, "{}: {:.3} mm", entry.name, margin * 1e3);
        if entry.name == "test-2" {
            assert!((margin + 0.15e-3).abs() < 1e-9, "{margin}");
        }
    }
}

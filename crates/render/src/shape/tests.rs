use super::*;

const SIZE: Vec3 = Vec3::new(0.08, 0.03, 0.02);

fn towards(origin: Vec3, target: Vec3) -> Ray {
    Ray { origin, direction: (target - origin).normalize() }
}

#[test]
fn a_ray_along_an_axis_enters_the_middle_of_a_face() {
    for radius in [0.0, 0.004] {
        let shape = Shape::new(SIZE, radius);
        for axis in 0..3 {
            for sign in [-1.0, 1.0] {
                let origin = sign * Vec3::AXES[axis];
                let entry = shape.entry(&towards(origin, Vec3::ZERO), 2.0).unwrap();
                assert!((entry.distance - (1.0 - SIZE[axis] / 2.0)).abs() < 1e-6);
                assert_eq!(entry.normal, origin);
            }
        }
    }
}

#[test]
fn a_ray_ends_before_the_block_or_begins_behind_it() {
    let shape = Shape::new(SIZE, 0.0);
    assert!(shape.entry(&towards(Vec3::X, Vec3::ZERO), 0.95).is_none());
    assert!(shape.entry(&Ray { origin: Vec3::X, direction: Vec3::X }, 2.0).is_none());
}

/// The chamfer's plane is at the corner of the edge less its width, over the root of two.
#[test]
fn a_diagonal_ray_meets_the_chamfer_at_its_distance() {
    let shape = Shape::new(Vec3::splat(0.02), 0.0);
    let direction = Vec3::new(-1.0, -1.0, 0.0).normalize();
    let entry = shape.entry(&Ray { origin: -direction, direction }, 2.0).unwrap();
    let depth = (0.01 + 0.01 - CHAMFER) / 2.0f32.sqrt();
    assert!((entry.distance - (1.0 - depth)).abs() < 1e-6);
    assert_eq!(entry.part, IVec3::new(1, 1, 0));
    let direction = Vec3::NEG_ONE.normalize();
    let entry = shape.entry(&Ray { origin: -direction, direction }, 2.0).unwrap();
    let depth = (0.03 - 2.0 * CHAMFER) / 3.0f32.sqrt();
    assert!((entry.distance - (1.0 - depth)).abs() < 1e-6);
    assert_eq!(entry.part, IVec3::ONE);
}

/// On the diagonal of an edge a round box ends at the core's edge and a radius beyond.
#[test]
fn a_diagonal_ray_meets_a_round_edge_and_a_round_corner_at_their_distance() {
    let (half, radius) = (0.01, 0.003);
    let shape = Shape::new(Vec3::splat(2.0 * half), radius);
    for (diagonal, n) in [(Vec3::new(1.0, 0.0, 1.0), 2.0f32), (Vec3::ONE, 3.0)] {
        let direction = -diagonal.normalize();
        let entry = shape.entry(&Ray { origin: -direction, direction }, 2.0).unwrap();
        let depth = (half - radius) * n.sqrt() + radius;
        assert!((entry.distance - (1.0 - depth)).abs() < 1e-6, "{}", entry.distance);
        assert!(entry.normal.normalize().abs_diff_eq(diagonal.normalize(), 1e-3));
    }
}

/// Signed distance of a rounded box, by Quilez's formula.
fn distance(half: Vec3, radius: f32, p: Vec3) -> f32 {
    let q = p.abs() - (half - Vec3::splat(radius));
    q.max(Vec3::ZERO).length() + q.max_element().min(0.0) - radius
}

/// From all sides, a ray that enters a round box does so on its surface, along its gradient; one
/// that does not enter stays outside of it.
#[test]
fn a_round_box_is_all_within_a_radius_of_its_core() {
    let (half, radius) = (SIZE / 2.0, 0.004);
    let shape = Shape::new(SIZE, radius);
    let mut hits = 0;
    for i in 0..40 {
        for j in 0..40 {
            let (u, v) = (i as f32 / 39.0 - 0.5, j as f32 / 39.0 - 0.5);
            let origin = Vec3::new(0.5 * u, 0.3, 0.4 * v + 0.1);
            let ray = towards(origin, Vec3::new(0.09 * v, 0.01 * u, 0.03 * u));
            match shape.entry(&ray, 2.0) {
                Some(entry) => {
                    hits += 1;
                    let p = ray.at(entry.distance);
                    assert!(distance(half, radius, p).abs() < 2e-6);
                    let step = p + 1e-3 * entry.normal.normalize();
                    assert!((distance(half, radius, step) - 1e-3).abs() < 1e-5);
                }
                None => {
                    for k in 0..200 {
                        assert!(distance(half, radius, ray.at(0.003 * k as f32)) > -1e-6);
                    }
                }
            }
        }
    }
    assert!((100..1500).contains(&hits), "{hits}");
}

/// Points on both sides of a surface that rays enter are in the shape and outside of it.
#[test]
fn a_shape_contains_the_points_beneath_its_surface() {
    for radius in [0.0, 0.004] {
        let shape = Shape::new(SIZE, radius);
        for i in 0..30 {
            for j in 0..30 {
                let (u, v) = (0.2 * i as f32, 0.1 * j as f32 - 1.5);
                let direction = -Vec3::new(libm::cosf(u), libm::sinf(u), v).normalize();
                let ray = Ray { origin: -direction, direction };
                let entry = shape.entry(&ray, 2.0).unwrap();
                assert!(shape.contains(ray.at(entry.distance + 2e-5)), "{direction}");
                assert!(!shape.contains(ray.at(entry.distance - 2e-5)), "{direction}");
                assert!(shape.is_met(&Ray { origin: 0.001 * direction, direction }));
            }
        }
    }
}

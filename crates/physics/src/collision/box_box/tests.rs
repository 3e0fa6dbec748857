//! Box against box, compared with a reference that shares no formula with it: all vertices
//! projected on all axes, and the overlap of two faces from inclusion and crossing instead of
//! clipping.

use glam::{DMat3, DQuat, DVec2, DVec3};
use proptest::prelude::*;

use super::*;
use crate::body::FLOOR;
use crate::collision::box_floor::box_floor;
use crate::constants::{CORNER_MERGE, EDGE_PREFERENCE, MIN_AREA, MIN_EDGE_SINE, MIN_EDGE_TILT, REFERENCE_AREA};

fn cuboid(body: u32, size: [f64; 3], q: [f64; 4], center: [f64; 3]) -> Cuboid {
    Cuboid {
        body,
        center: center.into(),
        axes: DMat3::from_quat(DQuat::from_array(q).normalize()),
        half: DVec3::from(size) / 2.0,
        ..Cuboid::default()
    }
}

/// Slabs, needles and cubes of about the size of a block, in any orientation, near enough to make
/// contact likely.
fn pairs() -> impl Strategy<Value = (Cuboid, Cuboid)> {
    let size = || prop_oneof![Just([0.081, 0.0268, 0.018]), prop::array::uniform3(0.002..0.1f64)];
    let orientation = || {
        prop_oneof![
            // Upright with a yaw, nearly upright, and arbitrary.
            (-1.0..1.0f64, 0.1..1.0f64).prop_map(|(z, w)| [0.0, 0.0, z, w]),
            (-1e-3..1e-3f64, -1e-3..1e-3f64, -1.0..1.0f64).prop_map(|(x, y, z)| [x, y, z, 1.0]),
            prop::array::uniform4(-1.0..1.0f64).prop_filter("no direction", |q| q.iter().any(|c| c.abs() > 0.1)),
        ]
    };
    let body = |i: u32, c: std::ops::Range<f64>| {
        (size(), orientation(), prop::array::uniform3(c)).prop_map(move |(s, q, c)| cuboid(i, s, q, c))
    };
    (body(0, -1e-9..1e-9), body(1, -0.05..0.05))
}

fn manifold(a: &Cuboid, b: &Cuboid, limit: f64, last: Option<LastAxis>) -> Option<Manifold> {
    let mut found = Manifold::new();
    (box_box(a, b, Range { limit, reach: limit }, last, &mut found) == PairStatus::Touching(f64::INFINITY))
        .then_some(found)
}

fn vertices(c: &Cuboid) -> [DVec3; 8] {
    std::array::from_fn(|i| {
        let sign = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        c.center + c.axes * (c.half * DVec3::new(sign(0), sign(1), sign(2)))
    })
}

/// Separation of the vertices along an axis, in either direction.
fn gap_along(a: &Cuboid, b: &Cuboid, axis: DVec3) -> f64 {
    let range = |c: &Cuboid| {
        let along = vertices(c).map(|v| v.dot(axis));
        (along.iter().copied().fold(f64::MAX, f64::min), along.iter().copied().fold(f64::MIN, f64::max))
    };
    let ((a0, a1), (b0, b1)) = (range(a), range(b));
    (b0 - a1).max(a0 - b1)
}

/// Best of the face axes and best of the edge axes, each with its separation.
fn reference(a: &Cuboid, b: &Cuboid) -> [(f64, DVec3); 2] {
    let columns = |c: &Cuboid| [c.axes.x_axis, c.axes.y_axis, c.axes.z_axis];
    let best = |axes: &mut dyn Iterator<Item = DVec3>| {
        axes.map(|n| (gap_along(a, b, n), n))
            .fold((f64::MIN, DVec3::ZERO), |best, next| if next.0 > best.0 { next } else { best })
    };
    let crossed = columns(a).into_iter().flat_map(|x| columns(b).map(|y| x.cross(y)));
    let edges = &mut crossed.filter(|n| n.length() > MIN_EDGE_SINE * (1.0 + 1e-9)).map(DVec3::normalize);
    [best(&mut columns(a).into_iter().chain(columns(b))), best(edges)]
}

/// Area of the overlap of a convex quadrilateral and the rectangle |u| <= hu, |v| <= hv: corners of
/// each that lie inside the other and crossings of their edges, ordered by angle.
fn overlap_area(quad: [DVec2; 4], hu: f64, hv: f64) -> f64 {
    let rect = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(|(u, v)| DVec2::new(u * hu, v * hv));
    let turn = (quad[1] - quad[0]).perp_dot(quad[2] - quad[1]).signum();
    let mut points: Vec<DVec2> = quad.iter().copied().filter(|p| p.x.abs() <= hu && p.y.abs() <= hv).collect();
    points.extend(
        rect.iter().filter(|r| (0..4).all(|i| turn * (quad[(i + 1) % 4] - quad[i]).perp_dot(**r - quad[i]) >= 0.0)),
    );
    for i in 0..4 {
        for j in 0..4 {
            let (p, d) = (quad[i], quad[(i + 1) % 4] - quad[i]);
            let (r, e) = (rect[j], rect[(j + 1) % 4] - rect[j]);
            let det = d.perp_dot(e);
            if det.abs() < 1e-15 {
                continue;
            }
            let (s, t) = ((r - p).perp_dot(e) / det, (r - p).perp_dot(d) / det);
            if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
                points.push(p + d * s);
            }
        }
    }
    if points.len() < 3 {
        return 0.0;
    }
    let middle = points.iter().sum::<DVec2>() / points.len() as f64;
    points.sort_by(|p, q| (*p - middle).to_angle().total_cmp(&(*q - middle).to_angle()));
    0.5 * (0..points.len()).map(|i| (points[i] - middle).perp_dot(points[(i + 1) % points.len()] - middle)).sum::<f64>()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_best_axis_is_that_of_all_vertices_on_all_axes((a, b) in pairs()) {
        let [(faces, face), (edges, edge)] = reference(&a, &b);
        let best = faces.max(edges);
        // Boxes nearly flat on each other use the face axis.
        let flat = face.cross(edge).length() <= MIN_EDGE_TILT;
        match separation(&a, &b, f64::MAX, None) {
            None => prop_assert!(false, "no axis"),
            Some(found) => {
                prop_assert!(found.distance <= best + 1e-12);
                let expected = if edges - EDGE_PREFERENCE > faces && !flat { edges } else { faces };
                prop_assert!((found.distance - expected).abs() < 1e-12, "{} instead of {expected}", found.distance);
                prop_assert!((found.normal.length() - 1.0).abs() < 1e-9);
                prop_assert!(found.normal.dot(b.center - a.center) >= 0.0);
            }
        }
        prop_assert_eq!(separation(&a, &b, 1e-3, None).is_some(), best <= 1e-3);
    }

    #[test]
    fn points_lie_on_both_boxes_and_none_is_deeper_than_the_overlap((a, b) in pairs()) {
        let limit = 1e-3;
        let Some(found) = separation(&a, &b, limit, None) else { return Ok(()) };
        let Some(m) = manifold(&a, &b, limit, None) else { return Ok(()) };
        let (ca, cb) = if m.a == 0 { (a, b) } else { (b, a) };
        let normal = ca.axes * m.frame[0];
        prop_assert!(!m.points.is_empty() && m.points.len() <= 8);
        prop_assert!((m.points.iter().map(|p| p.weight).sum::<f64>() - 1.0).abs() < 1e-9);
        let inside = |p: DVec3, c: &Cuboid| (p.abs() - c.half).max_element() < 1e-9;
        let on_surface = |p: DVec3, c: &Cuboid| inside(p, c) && (c.half - p.abs()).min_element().abs() < 1e-9;
        for p in &m.points {
            prop_assert!(p.weight >= -1e-12);
            prop_assert!(on_surface(p.anchor_a, &ca), "{:?} is not on {:?}", p.anchor_a, ca.half);
            prop_assert!(on_surface(p.anchor_b, &cb), "{:?} is not on {:?}", p.anchor_b, cb.half);
            let apart = (cb.center + cb.axes * p.anchor_b) - (ca.center + ca.axes * p.anchor_a);
            prop_assert!((apart.dot(normal) - p.gap).abs() < 1e-12);
            if !matches!(m.axis, SeparatingAxis::Edges(_)) {
                prop_assert!((apart - normal * p.gap).length() < 1e-12);
                prop_assert!(p.gap >= found.distance - 1e-12);
            }
        }
        let [n, t1, t2] = m.frame;
        prop_assert!((n.cross(t1) - t2).length() < 1e-9 && (t1.length() - 1.0).abs() < 1e-9);
    }

    #[test]
    fn the_patch_of_two_faces_has_the_area_of_their_overlap((a, b) in pairs()) {
        let Some(m) = manifold(&a, &b, 1e-3, None) else { return Ok(()) };
        let (ca, cb) = if m.a == 0 { (a, b) } else { (b, a) };
        if matches!(m.axis, SeparatingAxis::Edges(_)) {
            return Ok(());
        }
        let k = (0..3).max_by(|&i, &j| m.frame[0][i].abs().total_cmp(&m.frame[0][j].abs())).unwrap();
        let (iu, iv) = ((k + 1) % 3, (k + 2) % 3);
        let n = ca.axes * m.frame[0];
        let facing = cb.axes.transpose() * n;
        let f = (0..3).max_by(|&i, &j| facing[i].abs().total_cmp(&facing[j].abs())).unwrap();
        let size = |i: usize| facing[i].abs();
        // Of two faces at 45 degrees either may be the incident one.
        prop_assume!((0..3).all(|i| i == f || size(i) < size(f) - 1e-6));
        let outward = -facing[f].signum();
        let quad = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(|(x, y)| {
            let mut local = DVec3::ZERO;
            local[f] = outward * cb.half[f];
            local[(f + 1) % 3] = x * cb.half[(f + 1) % 3];
            local[(f + 2) % 3] = y * cb.half[(f + 2) % 3];
            let p = ca.axes.transpose() * (cb.center + cb.axes * local - ca.center);
            DVec2::new(p[iu], p[iv])
        });
        let expected = overlap_area(quad, ca.half[iu], ca.half[iv]);
        let clamped = (expected / REFERENCE_AREA).max(MIN_AREA);
        // Merging corners changes the area by at most their distance times the circumference.
        let tolerance = CORNER_MERGE * 4.0 * (ca.half[iu] + ca.half[iv]) / REFERENCE_AREA;
        prop_assert!((m.area_ratio - clamped).abs() < tolerance, "{} instead of {clamped}", m.area_ratio);
    }

    #[test]
    fn the_order_of_the_boxes_does_not_matter((a, b) in pairs()) {
        let (x, y) = (Cuboid { body: 0, ..b }, Cuboid { body: 1, ..a });
        let (one, two) = (separation(&a, &b, 1e-3, None), separation(&x, &y, 1e-3, None));
        prop_assert_eq!(one.is_some(), two.is_some());
        if let (Some(one), Some(two)) = (one, two) {
            prop_assert!((one.distance - two.distance).abs() < 1e-12);
        }
    }
}

#[test]
fn crossed_blocks_touch_at_the_corners_of_their_overlap() {
    let size = [0.081, 0.0268, 0.018];
    let a = cuboid(0, size, [0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.009]);
    let b = cuboid(1, size, [0.0, 0.0, 1.0, 1.0], [0.0271, 0.01, 0.027 + 1e-5]);
    let m = manifold(&a, &b, 1e-4, None).unwrap();
    assert_eq!(m.points.len(), 4);
    assert!((m.area_ratio - 1.0).abs() < 1e-12);
    for p in &m.points {
        assert!((p.weight - 0.25).abs() < 1e-12 && (p.gap - 1e-5).abs() < 1e-12);
        assert!((p.arm[0].abs() - 0.0134).abs() < 1e-12 && (p.arm[1].abs() - 0.0134).abs() < 1e-12);
    }
}

#[test]
fn the_axis_of_the_last_detection_stays_while_it_is_nearly_the_best() {
    let a = cuboid(0, [0.02; 3], [0.0, 0.0, 0.0, 1.0], [0.0; 3]);
    let b = cuboid(1, [0.02; 3], [0.0, 0.0, 0.0, 1.0], [0.0199, 0.0, 0.01988]);
    let axis = |last| separation(&a, &b, 1e-3, last).unwrap().axis;
    assert_eq!(axis(None), SeparatingAxis::FaceLow(0));
    let up = Some(LastAxis { axis: SeparatingAxis::FaceLow(2), normal: DVec3::Z });
    assert_eq!(axis(up), SeparatingAxis::FaceLow(2));
    let c = Cuboid { center: DVec3::new(0.0199, 0.0, 0.0198), ..b };
    assert_eq!(separation(&a, &c, 1e-3, up).unwrap().axis, SeparatingAxis::FaceLow(0));
}

#[test]
fn a_box_pressed_beyond_the_middle_of_another_stays_on_its_side() {
    let a = cuboid(0, [0.1, 0.1, 0.001], [0.0, 0.0, 0.0, 1.0], [0.0; 3]);
    let pressed = |z: f64| cuboid(1, [0.1, 0.1, 0.001], [0.0, 0.02, 0.01, 1.0], [0.001, 0.0, z]);
    let mut last = None;
    for step in 0..15 {
        let b = pressed(0.001 - 1e-4 * step as f64);
        let found = separation(&a, &b, 1e-3, last).unwrap();
        assert!(found.normal.z > 0.99, "step {step}: {found:?}");
        last = Some(LastAxis { axis: found.axis, normal: found.normal });
    }
    // without a last detection the near side is out
    assert!(separation(&a, &pressed(-4e-4), 1e-3, None).unwrap().normal.z < -0.99);
    // on the far side, apart, it is a new contact
    assert!(separation(&a, &pressed(-0.0035), 1.0, last).unwrap().normal.z < -0.99);
}

#[test]
fn a_box_meets_the_floor_with_its_lowest_face() {
    let flat = cuboid(0, [0.081, 0.0268, 0.018], [0.0, 0.0, 0.3, 1.0], [0.3, 0.2, 0.009]);
    let on_floor = |c: &Cuboid, limit| {
        let mut found = Manifold::new();
        (box_floor(c, Range { limit, reach: limit }, None, &mut found) == PairStatus::Touching(f64::INFINITY))
            .then_some(found)
    };
    let m = on_floor(&flat, 1e-4).unwrap();
    assert_eq!((m.points.len(), m.a), (4, FLOOR));
    assert!(m.points.iter().all(|p| p.gap.abs() < 1e-12 && p.anchor_a.z == 0.0));
    assert!(on_floor(&Cuboid { center: DVec3::new(0.0, 0.0, 0.01), ..flat }, 1e-4).is_none());
    // Balanced on an edge, two corners are down and two are up.
    let tipped = cuboid(0, [0.02; 3], [0.3, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0136]);
    let m = on_floor(&tipped, 1e-2).unwrap();
    assert_eq!(m.points.iter().filter(|p| p.gap < 1e-3).count(), 2);
}

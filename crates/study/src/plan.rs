//! Plan view of blocks: rectangles, and the polygon in which two of them overlap.

use glam::{DQuat, DVec2, DVec3};
use teeter_scene::Block;

/// Tilt up to which a block stands upright, rad: an end of the nominal block then rises by 0.4 um.
const UPRIGHT: f64 = 1e-5;
/// Distance below which two corners are one, m.
const MERGE: f64 = 1e-7;

/// Height of a block's upper face, m.
pub fn top(block: &Block) -> f64 {
    block.pos[2] + 0.5 * block.size[2]
}

/// Height of a block's lower face, m.
pub fn bottom(block: &Block) -> f64 {
    block.pos[2] - 0.5 * block.size[2]
}

/// Centre of a block, m.
pub fn center(block: &Block) -> DVec2 {
    DVec2::new(block.pos[0], block.pos[1])
}

/// Returns true if a block stands upright, turned about the vertical alone.
pub fn is_upright(block: &Block) -> bool {
    let up = DQuat::from_array(block.rotation()) * DVec3::Z;
    up.z > 0.0 && up.truncate().length() <= UPRIGHT
}

/// Unit vectors along length and width, of an upright block.
fn axes(block: &Block) -> [DVec2; 2] {
    let (sin, cos) = match block.orientation {
        None => libm::sincos(block.yaw),
        Some(_) => {
            let along = (DQuat::from_array(block.rotation()) * DVec3::X).truncate().normalize_or(DVec2::X);
            (along.y, along.x)
        }
    };
    [DVec2::new(cos, sin), DVec2::new(-sin, cos)]
}

/// Unit vector along the longer horizontal edge of an upright block: forwards is along it,
/// backwards against it.
///
/// ```
/// let scene = teeter_scene::named("block").unwrap();
/// assert_eq!(teeter_study::long_axis(&scene.blocks[0]), glam::DVec2::X);
/// ```
pub fn long_axis(block: &Block) -> DVec2 {
    axes(block)[usize::from(block.size[1] > block.size[0])]
}

/// Unit vector along the longest edge of a block that lies within 45 degrees of level; of an
/// upright block as [`long_axis`].
///
/// ```
/// # use teeter_scene::Block;
/// // on its end, turned by a quarter about y
/// let half = std::f64::consts::FRAC_1_SQRT_2;
/// let block = Block::new(0, [0.081, 0.0268, 0.018], 0.0196, [0.0, 0.0, 0.0405]);
/// let on_end = Block { orientation: Some([0.0, half, 0.0, half]), ..block };
/// assert!(teeter_study::pull_axis(&on_end).distance(glam::DVec3::Y) < 1e-12);
/// ```
pub fn pull_axis(block: &Block) -> DVec3 {
    if is_upright(block) {
        return long_axis(block).extend(0.0);
    }
    let rotation = DQuat::from_array(block.rotation());
    let edges = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| rotation * axis).into_iter().zip(block.size);
    // Two of three perpendicular directions are within 45 degrees of level.
    let level = edges.filter(|(edge, _)| edge.z * edge.z <= 0.5);
    level.reduce(|a, b| if b.1 > a.1 { b } else { a }).map_or(DVec3::X, |(edge, _)| edge)
}

/// Corners of a block, anticlockwise, m.
pub fn corners(block: &Block) -> Vec<DVec2> {
    let [u, v] = axes(block);
    let (u, v, c) = (u * (0.5 * block.size[0]), v * (0.5 * block.size[1]), center(block));
    vec![c - u - v, c + u - v, c + u + v, c - u + v]
}

/// Corners of the region in which two blocks overlap, anticlockwise; empty where they do not
/// (Sutherland and Hodgman 1974).
pub fn overlap(a: &Block, b: &Block) -> Vec<DVec2> {
    let mut region = corners(a);
    let edges = corners(b);
    for (i, &start) in edges.iter().enumerate() {
        region = clipped(&region, start, edges[(i + 1) % edges.len()] - start);
    }
    without_slivers(region)
}

/// Part of a region to the left of the line through `start` along `along`.
fn clipped(region: &[DVec2], start: DVec2, along: DVec2) -> Vec<DVec2> {
    let inside = |p: DVec2| along.perp_dot(p - start);
    let mut next: Vec<DVec2> = Vec::new();
    for (j, &to) in region.iter().enumerate() {
        let from = region[(j + region.len() - 1) % region.len()];
        let (d0, d1) = (inside(from), inside(to));
        if (d0 >= 0.0) != (d1 >= 0.0) {
            next.push(from + (to - from) * (d0 / (d0 - d1)));
        }
        if d1 >= 0.0 {
            next.push(to);
        }
    }
    next
}

/// Region with corners that are apart; empty where blocks only touch along an edge.
fn without_slivers(region: Vec<DVec2>) -> Vec<DVec2> {
    let mut merged: Vec<DVec2> = Vec::new();
    for corner in region {
        if merged.iter().all(|p| p.distance(corner) > MERGE) {
            merged.push(corner);
        }
    }
    if merged.len() < 3 || area(&merged) < MERGE * MERGE { Vec::new() } else { merged }
}

/// Convex polygon (anticlockwise) with each edge moved inwards by `distance`, m; outwards where
/// that is negative. Empty where nothing is left.
pub fn inset(polygon: &[DVec2], distance: f64) -> Vec<DVec2> {
    let n = polygon.len();
    let edge = |i: usize| polygon[(i + 1) % n] - polygon[i];
    let inward = |i: usize| edge(i).normalize_or_zero().perp();
    if distance < 0.0 {
        // corners of the moved edges, each next to the one before
        let corner = |i: usize| {
            let (before, after) = (inward((i + n - 1) % n), inward(i));
            polygon[i] + (before + after) * (distance / (1.0 + before.dot(after)))
        };
        return (0..n).map(corner).collect();
    }
    let move_in = |region: Vec<DVec2>, i: usize| clipped(&region, polygon[i] + inward(i) * distance, edge(i));
    without_slivers((0..n).fold(polygon.to_vec(), move_in))
}

/// Area of a polygon, m².
pub fn area(polygon: &[DVec2]) -> f64 {
    let n = polygon.len();
    0.5 * (0..n).map(|i| polygon[i].perp_dot(polygon[(i + 1) % n])).sum::<f64>()
}

/// Convex hull of points, anticlockwise (Andrew's monotone chain, 1979).
pub fn convex_hull(points: &[DVec2]) -> Vec<DVec2> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
    let chain = |order: &mut dyn Iterator<Item = &DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for &p in order {
            while let [.., a, b] = chain[..] {
                if (b - a).perp_dot(p - b) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        // the last point of one chain is the first of the other
        chain.pop();
        chain
    };
    let mut hull = chain(&mut sorted.iter());
    hull.extend(chain(&mut sorted.iter().rev()));
    hull
}

/// Distance from a point within a convex polygon (anticlockwise) to its edge along a direction, m;
/// none where the point is outside.
pub fn distance_to_edge(polygon: &[DVec2], from: DVec2, direction: DVec2) -> Option<f64> {
    let mut distance = f64::INFINITY;
    for (i, &p) in polygon.iter().enumerate() {
        let edge = polygon[(i + 1) % polygon.len()] - p;
        let (inside, approach) = (edge.perp_dot(from - p), -edge.perp_dot(direction));
        if inside < -MERGE * edge.length() {
            return None;
        }
        if approach > 0.0 {
            distance = distance.min(inside / approach);
        }
    }
    Some(distance.max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(x: f64, y: f64, yaw: f64) -> Block {
        Block { yaw, ..Block::new(0, [0.081, 0.0268, 0.018], 0.0196, [x, y, 0.009]) }
    }

    #[test]
    fn a_rotation_is_the_same_as_a_yaw_and_as_a_quaternion() {
        let turned = block(0.01, 0.02, 0.7);
        let same = Block { yaw: 0.0, orientation: Some(turned.rotation()), ..turned.clone() };
        assert!(is_upright(&same) && long_axis(&same).distance(long_axis(&turned)) < 1e-12);
        assert!(corners(&same).iter().zip(corners(&turned)).all(|(a, b)| a.distance(b) < 1e-12));
        let tilted = Block { orientation: Some([1e-3, 0.0, 0.0, 1.0]), ..turned };
        assert!(!is_upright(&tilted) && pull_axis(&tilted).distance(DVec3::X) < 1e-12);
    }

    #[test]
    fn crossed_blocks_overlap_in_a_square() {
        let region = overlap(&block(0.0, 0.0271, 0.0), &block(0.0271, 0.0, std::f64::consts::FRAC_PI_2));
        assert_eq!(region.len(), 4);
        assert!((area(&region) - 0.0268 * 0.0268).abs() < 1e-12);
        assert!(region.iter().all(|p| (*p - DVec2::splat(0.0271)).abs().max_element() < 0.0134 + 1e-9));
    }

    #[test]
    fn the_overlap_of_rotated_blocks_has_the_area_of_their_common_cells() {
        let (a, b) = (block(0.0, 0.0, 0.3), block(0.03, 0.01, -0.2));
        let region = overlap(&a, &b);
        let contains = |block: &Block, p: DVec2| {
            let [u, v] = axes(block);
            let d = p - center(block);
            d.dot(u).abs() < 0.0405 && d.dot(v).abs() < 0.0134
        };
        let n = 1000;
        let cell = |i: usize| 0.1 * ((i as f64 + 0.5) / n as f64 - 0.5);
        let inside = (0..n * n)
            .map(|i| DVec2::new(cell(i % n), cell(i / n)))
            .filter(|&p| contains(&a, p) && contains(&b, p))
            .count();
        let counted = inside as f64 * 0.01 / (n * n) as f64;
        assert!((area(&region) / counted - 1.0).abs() < 2e-3, "{} and {counted}", area(&region));
    }

    #[test]
    fn an_inset_moves_each_edge_by_its_distance() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]].map(DVec2::from);
        for distance in [0.1, -0.1] {
            let moved = inset(&square, distance);
            assert_eq!(moved.len(), 4);
            assert!((area(&moved) - (2.0 - 2.0 * distance) * (1.0 - 2.0 * distance)).abs() < 1e-12);
        }
        assert!(inset(&square, 0.5).is_empty());
        // a short edge vanishes: the triangle without a corner becomes a triangle
        let cut = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.05], [0.05, 1.0], [0.0, 1.0]].map(DVec2::from);
        assert_eq!(inset(&cut, 0.2).len(), 3);
    }

    #[test]
    fn the_distance_to_the_edge_of_a_hull_is_that_along_the_direction() {
        let points: Vec<DVec2> =
            [[0.0, 0.0], [2.0, 0.0], [1.0, 0.5], [2.0, 1.0], [0.0, 1.0], [1.0, 1.0]].map(DVec2::from).to_vec();
        let hull = convex_hull(&points);
        assert_eq!(hull.len(), 4);
        assert!((area(&hull) - 2.0).abs() < 1e-12);
        let from = DVec2::new(0.5, 0.25);
        assert_eq!(distance_to_edge(&hull, from, DVec2::X), Some(1.5));
        assert_eq!(distance_to_edge(&hull, from, DVec2::NEG_Y), Some(0.25));
        assert_eq!(distance_to_edge(&hull, DVec2::new(-0.1, 0.5), DVec2::X), None);
    }

    #[test]
    fn neighbouring_blocks_do_not_overlap() {
        assert!(overlap(&block(0.0, 0.0, 0.0), &block(0.0, 0.0268, 0.0)).is_empty());
        assert!(overlap(&block(0.0, 0.0, 0.0), &block(0.0, 0.0271, 0.0)).is_empty());
    }
}

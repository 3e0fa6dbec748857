//! Forces of the springs of a block, four at a time. Every lane rounds as [`Spring::force`] does,
//! so both give the same bits.

use glam::DVec3;
use wide::f64x4;

use super::block::SPRINGS;
use super::options::SpringSet;
use super::particle::State;
use super::spring::Spring;

/// Number of springs at a time.
const LANES: usize = 4;

/// Springs of a block that exist, in the order of its list, in groups of [`LANES`].
#[derive(Debug, Clone, Default)]
pub struct Present {
    groups: Vec<[u8; LANES]>,
    rest: Vec<u8>,
}

impl Present {
    /// Springs of a set.
    pub fn of(set: SpringSet) -> Self {
        let mask = set.mask();
        let indices: Vec<u8> = (0..SPRINGS as u8).filter(|n| mask >> n & 1 == 1).collect();
        let (groups, rest) = indices.as_chunks();
        Self { groups: groups.to_vec(), rest: rest.to_vec() }
    }
}

/// Adds the forces of the springs of a block to the states of all particles.
#[inline(never)]
pub fn add_forces(springs: &[Spring], present: &Present, states: &mut [State]) {
    for group in &present.groups {
        let [a, b, c, d] = group.map(|n| &springs[usize::from(n)]);
        let [x, y, z] = forces([a, b, c, d], states);
        add(a, DVec3::new(x[0], y[0], z[0]), states);
        add(b, DVec3::new(x[1], y[1], z[1]), states);
        add(c, DVec3::new(x[2], y[2], z[2]), states);
        add(d, DVec3::new(x[3], y[3], z[3]), states);
    }
    for n in &present.rest {
        let spring = &springs[usize::from(*n)];
        add(spring, spring.force(&states[spring.p1 as usize], &states[spring.p2 as usize]), states);
    }
}

/// Adds a force on the second particle of a spring, and its opposite on the first.
#[inline]
fn add(spring: &Spring, force: DVec3, states: &mut [State]) {
    states[spring.p2 as usize].force += force; // Eq. 4.2b
    states[spring.p1 as usize].force -= force; // Eq. 4.2b
}

/// Components of the forces on the second particles, N.
#[inline]
fn forces(springs: [&Spring; LANES], states: &[State]) -> [[f64; LANES]; 3] {
    let ends = springs.map(|spring| (&states[spring.p1 as usize], &states[spring.p2 as usize]));
    let apart = transpose(ends.map(|(first, second)| second.position - first.position)); // Eq. 4.3b
    let closing = transpose(ends.map(|(first, second)| second.velocity - first.velocity)); // Eq. 4.3b
    let [stiffness, damping] = [springs.map(|s| s.stiffness), springs.map(|s| s.damping)].map(f64x4::new);
    let length = dot(apart, apart).sqrt();
    let pull = -stiffness * (length - f64x4::new(springs.map(|s| s.rest_length))); // Eq. 4.1
    let drag = -damping * dot(closing, apart) / length; // Eq. 4.3a
    let scale = (pull + drag) / length;
    let has_length = length.simd_ne(f64x4::ZERO);
    apart.map(|component| ((component * scale) & has_length).to_array()) // Eq. 4.2a
}

/// Components of vectors as lanes.
#[inline]
fn transpose([a, b, c, d]: [DVec3; LANES]) -> [f64x4; 3] {
    [[a.x, b.x, c.x, d.x], [a.y, b.y, c.y, d.y], [a.z, b.z, c.z, d.z]].map(f64x4::new)
}

#[inline]
fn dot(a: [f64x4; 3], b: [f64x4; 3]) -> f64x4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

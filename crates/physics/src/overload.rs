//! Overloads: contacts of a new world that cannot carry the weight on them.
//!
//! A contact is a spring. Where it gives by a good part of a block, faces no longer meet as faces,
//! and blocks sink into each other and through the floor. The loads of a scene are known before
//! time begins: each block passes its weight, and all that rests on it, to the blocks beneath.

use glam::DVec3;
use teeter_scene::Scene;

use crate::body::{FLOOR, largest_face};
use crate::build_error::BuildError;
use crate::cluster::Cluster;
use crate::collision::manifold::Manifold;
use crate::collision::passivity::thickness;
use crate::collision::stable_spring::stable_spring;
use crate::constants::{MAX_SAG, REFERENCE_AREA, TOUCH_GAP};

/// Smallest vertical part of the normal of a contact that bears weight.
const MIN_BEARING: f64 = 0.5;

/// Load of a contact.
#[derive(Debug, Clone, Copy)]
struct Load {
    /// Body that rests on the contact.
    body: u32,
    /// Body that bears it, or the floor.
    bearer: u32,
    /// Normal force, N.
    force: f64,
    /// Stiffness of the contact, N/m.
    stiffness: f64,
    /// Smallest edge of the two bodies, m.
    thickness: f64,
}

impl Load {
    /// Depth over the greatest that a contact may have.
    fn excess(&self) -> f64 {
        self.force / self.stiffness / (MAX_SAG * self.thickness)
    }
}

/// Checks that no contact of a new world, all of whose bodies are in `cluster`, gives by more than
/// [`MAX_SAG`] of a block.
pub fn check(cluster: &Cluster, scene: &Scene) -> Result<(), BuildError> {
    let loads = landings(cluster, scene.gravity).chain(loads(cluster, scene.gravity));
    let Some(worst) = loads.max_by(|a, b| a.excess().total_cmp(&b.excess())).filter(|load| load.excess() > 1.0) else {
        return Ok(());
    };
    let id = |i: u32| scene.blocks[i as usize].id;
    Err(BuildError::Overload {
        id: id(worst.body),
        bearer: if worst.bearer == FLOOR { "the floor".into() } else { format!("block {}", id(worst.bearer)) },
        load: worst.force,
        depth: worst.force / worst.stiffness,
        stiffness: worst.excess() * scene.stiffness,
    })
}

/// Loads of the contacts that bear weight. A block rests on its contacts in proportion to their
/// stiffness.
fn loads(cluster: &Cluster, gravity: f64) -> Vec<Load> {
    let Cluster { shapes, bodies, .. } = cluster;
    let mut bearing: Vec<Vec<Load>> = vec![Vec::new(); cluster.len()];
    for manifold in &cluster.contacts.manifolds {
        if let Some((body, bearer)) = bearing_pair(cluster, manifold) {
            let (stiffness, _) = stable_spring(manifold, shapes, bodies);
            let thickness = thickness(manifold, shapes);
            bearing[body as usize].push(Load { body, bearer, force: 0.0, stiffness, thickness });
        }
    }
    let mut order: Vec<usize> = (0..cluster.len()).filter(|&i| !bodies.fixed[i]).collect();
    order.sort_by(|&i, &j| bodies.position[j].z.total_cmp(&bodies.position[i].z));
    let mut weight: Vec<f64> = shapes.mass.iter().map(|mass| mass * gravity).collect();
    for i in order {
        let total: f64 = bearing[i].iter().map(|load| load.stiffness).sum();
        for load in &mut bearing[i] {
            load.force = weight[i] * load.stiffness / total;
            if load.bearer != FLOOR {
                weight[load.bearer as usize] += load.force;
            }
        }
    }
    bearing.into_iter().flatten().collect()
}

/// Body that rests on a contact and what bears it; none where the contact is open or steep.
fn bearing_pair(cluster: &Cluster, manifold: &Manifold) -> Option<(u32, u32)> {
    let touches = manifold.points.iter().any(|p| p.gap < TOUCH_GAP);
    let (_, axes) = cluster.bodies.pose(manifold.a);
    let up = manifold.normal_in_world(&cluster.bodies, axes).dot(DVec3::Z);
    let (body, bearer) = if up > 0.0 { (manifold.b, manifold.a) } else { (manifold.a, manifold.b) };
    let bears = touches && up.abs() > MIN_BEARING && body != FLOOR && !cluster.bodies.fixed[body as usize];
    bears.then_some((body, bearer))
}

/// Loads of all blocks, each as if it lay on the floor on its largest face: also those that begin
/// in the air will land.
fn landings(cluster: &Cluster, gravity: f64) -> impl Iterator<Item = Load> {
    let Cluster { shapes, bodies, .. } = cluster;
    (0..cluster.len()).filter(|&i| !bodies.fixed[i]).map(move |i| Load {
        body: i as u32,
        bearer: FLOOR,
        force: shapes.mass[i] * gravity,
        stiffness: shapes.spring.stiffness * largest_face(shapes.half[i]) / REFERENCE_AREA,
        thickness: 2.0 * shapes.half[i].min_element(),
    })
}

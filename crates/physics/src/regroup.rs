//! Which bodies belong to which cluster.
//!
//! Each body has bounds of what it may sweep in a frame. Bodies of which these overlap are of one cluster, and clusters are stepped
//! apart from each other for a whole frame. The bounds are generous and kept until a body needs more, or much less, so that in a tower at
//! rest nothing is to be done; they are a part of the state, for the clusters follow from them.

use teeter_scene::Form;

use crate::body_id::BodyId;
use crate::broad_phase::{Bound, overlapping};
use crate::cluster::Cluster;
use crate::constants::{SWEEP_EXCESS, SWEEP_LEAST, SWEEP_SLACK, SWEEP_SPEED};
use crate::island::islands;
use crate::params::Params;

/// The clusters of a world, in the order of their first bodies.
#[derive(Debug, Clone, Default)]
pub struct Clusters {
    pub list: Vec<Cluster>,
    /// For each body of the world its cluster, and its index there.
    pub place: Vec<(u32, u32)>,
}

impl Clusters {
    /// All bodies in one.
    pub fn one(cluster: Cluster) -> Self {
        let place = (0..cluster.len() as u32).map(|i| (0, i)).collect();
        Self { list: vec![cluster], place }
    }

    /// The cluster of a body, and the body's index there.
    pub fn of(&self, body: u32) -> (&Cluster, usize) {
        let (cluster, i) = self.place[body as usize];
        (&self.list[cluster as usize], i as usize)
    }

    /// The same, to change it.
    pub fn of_mut(&mut self, body: u32) -> (&mut Cluster, usize) {
        let (cluster, i) = self.place[body as usize];
        (&mut self.list[cluster as usize], i as usize)
    }

    /// Brings the clusters up to date for a frame of `frame` (s), in which things from outside may move bodies at the speeds in
    /// `push` (m/s).
    pub fn regroup(&mut self, params: &Params, form: Form, frame: f64, push: &[(BodyId, f64)]) {
        // a cluster that has just been joined may be faster than a part of it was before
        loop {
            let mut pushed = vec![0.0; self.list.len()];
            for &(body, speed) in push {
                let pushed: &mut f64 = &mut pushed[self.place[body.index()].0 as usize];
                *pushed = pushed.max(speed);
            }
            let mut changed: Vec<usize> = Vec::new();
            for (c, (cluster, pushed)) in self.list.iter_mut().zip(pushed).enumerate() {
                if cluster.is_awake() && sweep(cluster, frame, pushed) {
                    changed.push(c);
                }
            }
            if changed.is_empty() || !self.divide(params, form, &changed) {
                return;
            }
        }
    }

    /// Divides anew what has changed and what that may reach; returns whether a cluster is another.
    fn divide(&mut self, params: &Params, form: Form, changed: &[usize]) -> bool {
        let reached =
            |c: usize| changed.contains(&c) || changed.iter().any(|&d| self.list[c].hull.overlaps(&self.list[d].hull));
        let involved: Vec<usize> = (0..self.list.len()).filter(|&c| reached(c)).collect();
        let mut ids: Vec<u32> = involved.iter().flat_map(|&c| self.list[c].ids.iter().copied()).collect();
        ids.sort_unstable();
        let swept: Vec<Bound> =
            ids.iter().map(|&id| self.of(id)).map(|(cluster, i)| cluster.contacts.swept[i]).collect();
        let pairs = overlapping(&swept);
        let root = islands(ids.len(), pairs.iter().copied());

        // members of each part, and each body's index in its part
        let mut parts: Vec<Vec<u32>> = Vec::new();
        let mut part_of = vec![0; ids.len()];
        let mut index_of = vec![0; ids.len()];
        for (i, &r) in root.iter().enumerate() {
            if r as usize == i {
                part_of[i] = parts.len();
                parts.push(Vec::new());
            } else {
                part_of[i] = part_of[r as usize];
            }
            index_of[i] = parts[part_of[i]].len() as u32;
            parts[part_of[i]].push(ids[i]);
        }
        let mut near: Vec<Vec<(u32, u32)>> = vec![Vec::new(); parts.len()];
        for &(a, b) in &pairs {
            near[part_of[a as usize]].push((index_of[a as usize], index_of[b as usize]));
        }

        let same = parts.len() == involved.len() && parts.iter().all(|part| self.of(part[0]).0.ids == *part);
        if !same {
            self.rebuild(params, form, &involved, &parts);
        }
        for (part, near) in parts.iter().zip(&near) {
            self.of_mut(part[0]).0.contacts.set_near(near);
        }
        if !same {
            self.meet(&parts);
        }
        !same
    }

    /// Divides a single cluster into parts of the given members.
    pub fn split(&mut self, params: &Params, form: Form, parts: &[Vec<u32>]) {
        self.rebuild(params, form, &[0], parts);
        self.list.iter_mut().for_each(|cluster| cluster.contacts.renew_near());
    }

    /// Puts clusters of the given members in the place of those involved.
    fn rebuild(&mut self, params: &Params, form: Form, involved: &[usize], parts: &[Vec<u32>]) {
        let mut next: Vec<Cluster> = Vec::new();
        for part in parts {
            let mut cluster = Cluster::new(params, form);
            let mut sources: Vec<u32> = Vec::new();
            for &id in part {
                let (source, i) = self.place[id as usize];
                cluster.push(&self.list[source as usize], i as usize);
                if !sources.contains(&source) {
                    sources.push(source);
                }
            }
            for source in sources {
                let source = &self.list[source as usize];
                let rename = |i: u32| part.binary_search(&source.ids[i as usize]).ok().map(|i| i as u32);
                cluster.adopt(&source.contacts.manifolds, rename);
            }
            next.push(cluster);
        }
        let mut c = 0;
        self.list.retain(|_| {
            c += 1;
            !involved.contains(&(c - 1))
        });
        self.list.extend(next);
        self.list.sort_by_key(|cluster| cluster.ids[0]);
        for (c, cluster) in self.list.iter().enumerate() {
            for (i, &id) in cluster.ids.iter().enumerate() {
                self.place[id as usize] = (c as u32, i as u32);
            }
        }
    }

    /// Looks at bodies that have come near each other in different clusters: a body that outgrew what it was expected to sweep.
    fn meet(&mut self, parts: &[Vec<u32>]) {
        for part in parts {
            let (cluster, _) = self.of_mut(part[0]);
            let contacts = &mut cluster.contacts;
            let unseen = |&(a, b): &(u32, u32)| contacts.find((a, b)).is_none();
            let mut due: Vec<u32> =
                overlapping(&contacts.bounds).into_iter().filter(unseen).flat_map(|(a, b)| [a, b]).collect();
            due.sort_unstable();
            due.dedup();
            let (pairs, _) = contacts.candidates(&cluster.shapes, &mut cluster.bodies, &due, SWEEP_LEAST);
            contacts.detect(&cluster.shapes, &mut cluster.bodies, &due, &pairs);
        }
    }
}

/// Grants the bodies of a cluster what they may sweep; returns whether anything has changed.
fn sweep(cluster: &mut Cluster, frame: f64, push: f64) -> bool {
    let reach = SWEEP_LEAST + SWEEP_SPEED * frame * cluster.speed().max(push);
    let mut changed = std::mem::take(&mut cluster.outgrown);
    for i in 0..cluster.len() {
        let needed = Bound::new(&cluster.shapes, &cluster.bodies, i, reach).union(&cluster.contacts.bounds[i]);
        let swept = &mut cluster.contacts.swept[i];
        if !swept.contains(&needed) || !needed.grown(SWEEP_EXCESS).contains(swept) {
            *swept = needed.grown(SWEEP_SLACK);
            changed = true;
        }
    }
    if changed {
        cluster.hull = cluster.contacts.swept.iter().fold(Bound::default(), |hull, bound| hull.union(bound));
    }
    changed
}

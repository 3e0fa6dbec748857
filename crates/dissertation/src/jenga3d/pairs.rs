//! Pairs of blocks in the order of their tests (section 3.3.4).

use super::model::Model;
use super::options::Order;
use super::particle::State;

/// Pairs of blocks, each with the event up to which it was tested.
#[derive(Debug, Clone, Default)]
pub struct Pairs {
    pairs: Vec<[u32; 2]>,
    tested: Vec<u32>,
}

impl Pairs {
    /// Lists all pairs for a step, none of them tested.
    pub fn reset(&mut self, model: &Model, order: Order, curr: &[State]) {
        let n = model.blocks.len() as u32;
        let count = (n as usize * (n as usize).saturating_sub(1)) / 2;
        if self.pairs.len() != count || order != Order::Naive {
            self.pairs.clear();
            let mut ranked: Vec<u32> = (0..n).collect();
            let height = |b: u32| model.blocks[b as usize].centre(curr).z;
            match order {
                Order::Naive => {}
                Order::BottomUp => ranked.sort_by(|&a, &b| height(a).total_cmp(&height(b))),
                Order::TopDown => ranked.sort_by(|&a, &b| height(b).total_cmp(&height(a))),
            }
            self.pairs.extend((0..ranked.len()).flat_map(|i| {
                let (a, rest) = (ranked[i], &ranked[i + 1..]);
                rest.iter().map(move |&b| [a, b])
            }));
        }
        self.tested.clear();
        self.tested.resize(self.pairs.len(), 0);
    }

    /// Number of pairs.
    pub fn len(&self) -> usize {
        self.pairs.len()
    }

    /// Indices of the blocks of a pair.
    pub fn blocks(&self, n: usize) -> [usize; 2] {
        self.pairs[n].map(|block| block as usize)
    }

    /// Event up to which a pair was tested.
    pub fn tested(&self, n: usize) -> u32 {
        self.tested[n]
    }

    /// Records that a pair was tested up to an event.
    pub fn set_tested(&mut self, n: usize, event: u32) {
        self.tested[n] = event;
    }
}

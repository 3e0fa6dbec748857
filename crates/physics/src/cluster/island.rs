//! Islands: connected components of bodies.

/// Lowest index in the connected component of each of `n` bodies, by union-find over pairs.
pub fn islands(n: usize, pairs: impl Iterator<Item = (u32, u32)>) -> Vec<u32> {
    let mut root: Vec<u32> = (0..n as u32).collect();
    fn find(root: &mut [u32], i: u32) -> u32 {
        let mut i = i;
        while root[i as usize] != i {
            root[i as usize] = root[root[i as usize] as usize];
            i = root[i as usize];
        }
        i
    }
    for (a, b) in pairs {
        let (a, b) = (find(&mut root, a), find(&mut root, b));
        root[a.max(b) as usize] = a.min(b);
    }
    (0..n as u32).map(|i| find(&mut root, i)).collect()
}

//! Islands: bodies that are joined to each other, directly or through others.

/// For each of `n` bodies the lowest index of those it is joined with.
pub fn islands(n: usize, joined: impl Iterator<Item = (u32, u32)>) -> Vec<u32> {
    let mut root: Vec<u32> = (0..n as u32).collect();
    fn find(root: &mut [u32], i: u32) -> u32 {
        let mut i = i;
        while root[i as usize] != i {
            root[i as usize] = root[root[i as usize] as usize];
            i = root[i as usize];
        }
        i
    }
    for (a, b) in joined {
        let (a, b) = (find(&mut root, a), find(&mut root, b));
        root[a.max(b) as usize] = a.min(b);
    }
    (0..n as u32).map(|i| find(&mut root, i)).collect()
}

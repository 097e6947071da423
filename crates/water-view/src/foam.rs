//! The foam texture: a tile of lace, its histogram flat, with all mips.

/// Texels per side of mip 0.
pub(crate) const SIZE: u32 = 256;
/// Mips down to one texel.
pub(crate) const MIPS: u32 = SIZE.ilog2() + 1;

/// A number in [0, 1) from three integers (PCG, O'Neill 2014).
fn hash(x: u32, y: u32, seed: u32) -> f32 {
    let mut h =
        (x.wrapping_mul(0x9e37_79b9) ^ y.wrapping_mul(0x85eb_ca6b)).wrapping_add(seed.wrapping_mul(0xc2b2_ae35));
    for _ in 0..2 {
        h = h.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        h = ((h >> ((h >> 28) + 4)) ^ h).wrapping_mul(277_803_737);
        h ^= h >> 22;
    }
    (h >> 8) as f32 / (1 << 24) as f32
}

/// Distances to the nearest and second nearest of one random point per cell, in cells; `cells` per period.
fn worley(x: f32, y: f32, cells: u32, seed: u32) -> (f32, f32) {
    let (cx, cy) = (x.floor() as i32, y.floor() as i32);
    let (mut first, mut second) = (9.0f32, 9.0f32);
    for j in -1..=1 {
        for i in -1..=1 {
            let (px, py) = (cx + i, cy + j);
            let (wx, wy) = (px.rem_euclid(cells as i32) as u32, py.rem_euclid(cells as i32) as u32);
            let dx = px as f32 + hash(wx, wy, seed) - x;
            let dy = py as f32 + hash(wx, wy, seed + 1) - y;
            let d = (dx * dx + dy * dy).sqrt();
            if d < first {
                (first, second) = (d, first);
            } else if d < second {
                second = d;
            }
        }
    }
    (first, second)
}

/// All mips, largest first, one byte a texel.
pub(crate) fn mips() -> Vec<Vec<u8>> {
    let n = SIZE as usize;
    let mut lace: Vec<f32> = (0..n * n)
        .map(|k| {
            let (u, v) = ((k % n) as f32 / n as f32, (k / n) as f32 / n as f32);
            [(7u32, 1.0f32), (15, 0.8), (33, 0.6), (71, 0.4)]
                .iter()
                .map(|&(cells, weight)| {
                    let c = cells as f32;
                    let (a, b) = worley(u * c, v * c, cells, cells * 7);
                    // Walls between bubbles are high, their middles low.
                    weight * (0.6 * (1.0 - (b - a)) + 0.4 * a)
                })
                .sum()
        })
        .collect();
    // Rank instead of value: a threshold at 1 - c then covers the share c.
    let mut order: Vec<usize> = (0..lace.len()).collect();
    order.sort_by(|&a, &b| lace[a].total_cmp(&lace[b]).then(a.cmp(&b)));
    for (rank, &k) in order.iter().enumerate() {
        lace[k] = rank as f32 / (n * n - 1) as f32;
    }
    let mut out = Vec::with_capacity(MIPS as usize);
    let mut size = n;
    loop {
        out.push(lace.iter().map(|v| (v * 255.0 + 0.5) as u8).collect());
        if size == 1 {
            return out;
        }
        let half = size / 2;
        lace = (0..half * half)
            .map(|k| {
                let at = 2 * (k % half) + 2 * (k / half) * size;
                0.25 * (lace[at] + lace[at + 1] + lace[at + size] + lace[at + size + 1])
            })
            .collect();
        size = half;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_threshold_covers_its_share_and_the_last_mip_is_the_mean() {
        let mips = mips();
        assert_eq!(mips.len(), MIPS as usize);
        for share in [0.1, 0.5, 0.8] {
            let above = mips[0].iter().filter(|v| f64::from(**v) > 255.0 * (1.0 - share)).count();
            let got = above as f64 / mips[0].len() as f64;
            assert!((got - share).abs() < 0.01, "{got} for {share}");
        }
        assert!((126..=129).contains(&mips[MIPS as usize - 1][0]));
    }

    #[test]
    fn the_tile_has_no_seam() {
        let n = SIZE as usize;
        let tile = &mips()[0];
        let step = |a: usize, b: usize| (f64::from(tile[a]) - f64::from(tile[b])).abs();
        let seam: f64 = (0..n).map(|j| step(j * n, j * n + n - 1)).sum();
        let inside: f64 = (0..n).map(|j| step(j * n + 100, j * n + 99)).sum();
        assert!(seam < 1.5 * inside, "{seam} {inside}");
    }
}

//! Two seas on different tiles, as mode sets of the same cascades: one can become the other then.

use open_water_shaders::surface::MAX_CASCADES;

use crate::error::check;
use crate::modes::set::ModeSet;
use crate::{CascadeDesc, CascadeModes, OceanDesc, OceanError};

/// How many cascades two seas may have on the way.
pub(crate) const TOGETHER: &str =
    "8 or fewer together with those of the sea before that are others: change in two steps, or sizes alone";

/// Two mode sets on the cascades of both.
pub(crate) struct Joined {
    pub(crate) from: ModeSet,
    pub(crate) to: ModeSet,
    /// Which cascade each was, in the sea before and in the sea after.
    pub(crate) places: Vec<[Option<usize>; 2]>,
}

/// Whether two seas have the same cascades.
pub(crate) fn alike(a: &ModeSet, b: &ModeSet) -> bool {
    let same = |(a, b): (&CascadeModes, &CascadeModes)| a.size == b.size && same_waves(a, b);
    a.modes.len() == b.modes.len() && a.modes.iter().zip(&b.modes).all(same)
}

/// Whether two cascades hold the same waves, up to the size of their arrays.
fn same_waves(a: &CascadeModes, b: &CascadeModes) -> bool {
    a.tile == b.tile && a.band == b.band
}

impl Joined {
    /// The cascades of both, longest first. Those that are the same are one. So are those that differ in size alone where
    /// there is no room for both, of the larger size: what arrays lose of short waves then changes at once.
    pub(crate) fn new(a: &ModeSet, b: &ModeSet) -> Result<Self, OceanError> {
        let placed = |one: &dyn Fn(&CascadeModes, &CascadeModes) -> bool| {
            let mut places: Vec<[Option<usize>; 2]> = (0..a.modes.len()).map(|i| [Some(i), None]).collect();
            for (j, modes) in b.modes.iter().enumerate() {
                match a.modes.iter().position(|own| one(own, modes)) {
                    Some(i) => places[i][1] = Some(j),
                    None => places.push([None, Some(j)]),
                }
            }
            places
        };
        let mut places = placed(&|a, b| a.size == b.size && same_waves(a, b));
        if places.len() > MAX_CASCADES {
            places = placed(&same_waves);
        }
        check("cascades", places.len() as f64, places.len() <= MAX_CASCADES, TOGETHER)?;
        let [own, other] = [a, b].map(|set| &set.modes);
        let both = |[i, j]: [Option<usize>; 2]| [i.map(|i| &own[i]), j.map(|j| &other[j])].into_iter().flatten();
        let tile = |place: [Option<usize>; 2]| both(place).map(|modes| modes.tile).fold(0.0, f32::max);
        places.sort_by(|a, b| tile(*b).total_cmp(&tile(*a)));
        let size = |place: [Option<usize>; 2]| both(place).map(|modes| modes.size).max().unwrap_or_default();
        let set = |set: &ModeSet, which: usize| {
            let modes = places.iter().map(|&place| {
                let like = both(place).next().unwrap_or(&own[0]);
                padded(place[which].map(|at| &set.modes[at]), like, size(place))
            });
            let cascades = places.iter().map(|&place| CascadeDesc::new(size(place), tile(place))).collect();
            let desc = OceanDesc { cascades, ..set.desc.clone() };
            let (recipe, spectra, notices) = (set.recipe.clone(), set.spectra.clone(), set.notices.clone());
            ModeSet::of(set.level, desc, recipe, spectra, modes.collect(), notices)
        };
        let (from, to) = (set(a, 0), set(b, 1));
        Ok(Self { from, to, places })
    }
}

/// The modes of the cascades that hold the same waves, two by two, in arrays of one size.
pub(crate) fn common(a: &ModeSet, b: &ModeSet) -> Vec<[CascadeModes; 2]> {
    let pairs = a.modes.iter().flat_map(|own| b.modes.iter().map(move |other| [own, other]));
    let pairs = pairs.filter(|[own, other]| same_waves(own, other));
    pairs.map(|pair| pair.map(|modes| padded(Some(modes), modes, pair[0].size.max(pair[1].size)))).collect()
}

/// Modes in arrays of another size, none where there are none, on the tile and in the band of another cascade.
fn padded(modes: Option<&CascadeModes>, like: &CascadeModes, size: u32) -> CascadeModes {
    let side = size as usize;
    let (mut amp, mut n) = (vec![[0.0; 4]; side * side], vec![0; side * side]);
    if let Some(modes) = modes {
        let own = modes.size as usize;
        let place = |index: usize| if index < own / 2 { index } else { index + side - own };
        for cell in 0..own * own {
            let at = place(cell / own) * side + place(cell % own);
            (amp[at], n[at]) = (modes.amp[cell], modes.n[cell]);
        }
    }
    CascadeModes { size, tile: like.tile, band: like.band, amp, n }
}

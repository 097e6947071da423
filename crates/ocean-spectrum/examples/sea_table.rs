//! Prints what the wind makes of the sea, or, given a sea file, what that sea is and which tiles suit it.

use std::error::Error;

use ocean_spectrum::{Ocean, OceanDesc, Partition, SeaState, Spectrum, Spreading, WaveSpectrum};

fn main() -> Result<(), Box<dyn Error>> {
    match std::env::args().nth(1) {
        Some(file) => describe(SeaState::from_file(file)?),
        None => table(),
    }
}

/// Significant height and peak period by wind and fetch, fully grown, and over 8 m of water.
fn table() -> Result<(), Box<dyn Error>> {
    println!("| Beaufort, wind | 10 km | 100 km | 500 km | grown | 100 km, 8 m deep |\n|---|---|---|---|---|---|");
    for (force, wind) in [(2, 2.5), (4, 6.7), (5, 9.4), (6, 12.3), (7, 15.5), (8, 19.0), (10, 26.5)] {
        let grown = Partition::new(Spectrum::PiersonMoskowitz { wind_speed: wind }, 0.0, Spreading::Cos2s { s: 6.0 });
        let seas = [
            SeaState::wind(wind, 10e3, 0.0),
            SeaState::wind(wind, 100e3, 0.0),
            SeaState::wind(wind, 500e3, 0.0),
            SeaState { partitions: vec![grown], depth: None },
            SeaState::tma(wind, 100e3, 0.0, 8.0),
        ];
        print!("| {force}, {wind} m/s |");
        for sea in seas {
            let sea = WaveSpectrum::new(&sea)?;
            print!(" {:.1} m, {:.1} s |", sea.significant_height(), sea.peak_period());
        }
        println!();
    }
    Ok(())
}

fn describe(sea: SeaState) -> Result<(), Box<dyn Error>> {
    let ocean = Ocean::new(OceanDesc::for_sea(sea, 256))?;
    println!("significant height  {:.2} m", ocean.significant_height());
    println!("peak period         {:.2} s", ocean.peak_period());
    println!("peak wavelength     {:.1} m", ocean.peak_wavelength());
    let tiles: Vec<_> = ocean.desc().cascades.iter().map(|cascade| format!("{:.1}", cascade.tile)).collect();
    println!("tiles of 256 texels {} m", tiles.join(", "));
    for notice in ocean.notices() {
        println!("note: {notice}");
    }
    Ok(())
}

//! Prints what the wind makes of the sea, or, given a sea file, what that sea is and which tiles suit it.

use std::error::Error;

use ocean_spectrum::{Ocean, OceanDesc, SeaState, WaveSpectrum};

fn main() -> Result<(), Box<dyn Error>> {
    match std::env::args().nth(1) {
        Some(file) => describe(SeaState::from_file(file)?),
        None => table(),
    }
}

fn table() -> Result<(), Box<dyn Error>> {
    println!("wind at 10 m | fetch  | Hs, m | Tp, s | length of the main waves, m");
    for (wind, fetch) in
        [(3.0, 10e3), (5.0, 30e3), (8.0, 60e3), (10.0, 100e3), (14.0, 200e3), (18.0, 300e3), (24.0, 500e3)]
    {
        let sea = WaveSpectrum::new(&SeaState::wind(wind, fetch, 0.0))?;
        let length = std::f64::consts::TAU / sea.peak_wavenumber();
        let (height, period) = (sea.significant_height(), sea.peak_period());
        println!("{wind:>8} m/s | {:>3} km | {height:5.2} | {period:5.1} | {length:5.0}", fetch / 1e3);
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

//! The cases of the evidence, one file a topic.

mod body_float;
mod body_flow;
mod body_forces;
mod body_hull;
mod body_slam;
mod body_swing;
mod dispersion;
mod dispersive_border;
mod dispersive_choice;
mod dispersive_shoal;
mod dispersive_step;
mod dispersive_walls;
mod dispersive_waves;
mod energy;
mod facade;
mod facade_grids;
mod fleet_gpu;
mod fleet_idle;
mod fleet_inertia;
mod fleet_kernel;
mod fleet_tick;
mod fleet_water;
mod frame_age;
mod frame_allocations;
mod frame_dry;
mod frame_encode;
mod frame_home;
mod frame_presets;
mod frame_rates;
mod frame_rules;
mod frame_scene;
mod frame_snapshot;
mod frame_soak;
mod frame_staging;
mod frame_store;
mod frame_upload;
mod frame_world;
mod grid_border;
mod grid_current;
mod grid_edges;
mod grid_gap;
mod grid_gpu;
mod grid_gpu_dispersive;
mod grid_gpu_error;
mod grid_gpu_plain;
mod grid_medium;
mod grid_moving;
mod grid_phase;
mod grid_shore;
mod grid_soak;
mod grid_sources;
mod grid_step;
mod grid_tiles;
mod grid_wake;
mod harbour;
mod heave_decay;
mod kelvin;
mod nested;
mod ocean_buoy;
mod ocean_fft;
mod ocean_gpu;
mod ocean_gpu_speed;
mod ocean_kernel;
mod ocean_query;
mod ocean_repeat;
mod ocean_time;
mod ocean_variance;
mod ocean_view;
mod rapier;
mod robust;
mod sinkage;

use crate::evidence::Case;

/// Every case, in the order of the report.
pub const CASES: &[Case] = &[
    ocean_fft::CPU,
    ocean_gpu::GPU,
    ocean_gpu_speed::SPEED,
    ocean_gpu_speed::PASSES,
    ocean_view::SEAS,
    ocean_view::VIEW,
    ocean_time::PHASE,
    ocean_time::RATE,
    ocean_time::CHANGE,
    ocean_variance::VARIANCE,
    ocean_variance::HS,
    ocean_buoy::TP,
    ocean_buoy::MOMENTS,
    ocean_repeat::REPEAT,
    ocean_query::QUERY,
    ocean_query::PATCHES,
    ocean_kernel::INTERPOLATION,
    ocean_kernel::LARGEST,
    grid_phase::PHASE,
    grid_wake::WEDGE,
    kelvin::KELVIN,
    kelvin::ENERGY,
    dispersion::DISPERSION,
    dispersive_choice::CHOICE,
    dispersive_waves::WAVES,
    dispersive_walls::WALL,
    dispersive_walls::GAP,
    dispersive_walls::ENERGY,
    dispersive_shoal::SHOALING,
    dispersive_border::STANDING,
    dispersive_border::MOVING,
    dispersive_step::STEP,
    grid_gap::DIFFRACTION,
    grid_border::PML,
    grid_moving::MOVING,
    grid_edges::GRAZING,
    grid_edges::KINDS,
    grid_border::SHIFT,
    grid_step::STEP,
    grid_tiles::TILES,
    grid_gpu_error::ERROR,
    grid_gpu_dispersive::ERROR,
    grid_gpu_dispersive::COST,
    grid_gpu::STEP,
    grid_gpu::TICK,
    grid_gpu::ACTIVE,
    grid_shore::SHOALING,
    grid_shore::STANDING,
    grid_sources::VOLUME,
    grid_sources::DROP,
    grid_sources::MAKER,
    grid_sources::TRAIN,
    grid_sources::HULLS,
    grid_current::CURRENT,
    nested::NESTED,
    grid_medium::PML,
    grid_medium::BOUND,
    grid_medium::COST,
    body_float::DRAFT,
    body_float::TICK,
    body_hull::HEELED,
    body_hull::POP,
    body_hull::MASS,
    body_hull::SPEED,
    fleet_kernel::KERNEL,
    fleet_inertia::ERROR,
    fleet_inertia::TIME,
    fleet_inertia::TUMBLE,
    body_swing::BARGE,
    body_swing::DECAY,
    body_swing::INTEGRATOR,
    body_flow::RESPONSE,
    body_flow::TERMINAL,
    body_flow::CURRENT,
    body_forces::SKIN,
    body_slam::SLAM,
    body_forces::WIND,
    body_forces::SLOPE,
    body_forces::ADDED_MASS,
    fleet_gpu::FLEET,
    fleet_water::AGAINST_BODY,
    fleet_water::REFRESH,
    fleet_idle::ASLEEP,
    fleet_idle::RIDING,
    heave_decay::HEAVE,
    heave_decay::ON_OFF,
    sinkage::SINKAGE,
    rapier::DRAFT,
    rapier::VS_OWN,
    facade::GPU_VS_CPU,
    facade::BODIES_EQUAL,
    harbour::SEAM,
    harbour::BASIN,
    harbour::GPU_VS_CPU,
    energy::ENERGY,
    grid_soak::SOAK,
    facade::EMPTY,
    facade::TICK,
    fleet_tick::TICK,
    facade_grids::HANDOVER,
    facade_grids::WAKES,
    robust::FUZZ,
    robust::TANK,
    robust::DRIFT,
    robust::ACCOUNT,
    frame_scene::SCENE,
    frame_store::STORE,
    frame_world::WORLD,
    frame_rates::RATES,
    frame_allocations::ALLOCATIONS,
    frame_rules::PLAN,
    frame_rules::RULES,
    frame_soak::SOAK,
    frame_presets::PRESETS,
    frame_presets::CHANGE,
    frame_dry::DRY,
    frame_age::AGE,
    frame_home::HOME,
    frame_upload::UPLOAD,
    frame_encode::ENCODE,
    frame_staging::STAGING,
    frame_snapshot::SNAPSHOT,
];

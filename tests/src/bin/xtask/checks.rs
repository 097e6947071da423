//! What is checked, in the order that fails soonest and builds least.
//!
//! Commands over the whole workspace share one set of features, hence one set of built dependencies. Only the
//! section "crates apart" builds a second, small one: the crates without wgpu.

use crate::{
    TestArgs, adapter,
    section::{Failure, Sections},
};

/// The published crates that work without wgpu.
const WITHOUT_WGPU: [&str; 5] = ["open-water-shaders", "floating-body", "ocean-spectrum", "wave-grid", "open-water"];

/// Features that need no wgpu, each by itself.
const ALONE: [(&str, &str); 9] = [
    ("floating-body", "mesh-files"),
    ("floating-body", "serde"),
    ("ocean-spectrum", "serde"),
    ("wave-grid", "serde"),
    ("open-water", "mesh-files"),
    ("open-water", "map-files"),
    ("open-water", "rapier"),
    ("open-water", "serde"),
    ("open-water", "tracing"),
];

/// An adapter, then every test and doc test; those of the façade without wgpu, too.
pub(crate) fn test(sections: &mut Sections, args: &TestArgs) -> Result<(), Failure> {
    sections.run("graphics adapter", |s| adapter::ensure(s, args.no_install, args.software))?;
    sections.run("tests", |s| s.cargo("test --workspace"))?;
    sections.run("crates apart", crates_apart)
}

/// All that continuous integration runs.
pub(crate) fn ci(sections: &mut Sections, args: &TestArgs) -> Result<(), Failure> {
    sections.run("format", |s| s.cargo("fmt --all --check"))?;
    test(sections, args)?;
    sections.run("lints", |s| s.cargo("clippy --workspace --all-targets -- -D warnings"))?;
    sections
        .run("documentation", |s| s.cargo_with_env("doc --workspace --no-deps", &[("RUSTDOCFLAGS", "-D warnings")]))?;
    sections.run("release build", |s| s.cargo("build --release --workspace --examples --bins"))?;
    sections.run("scenes", scenes)?;
    sections.run("evidence", |s| s.cargo("run --release --bin evidence -- --quick --out target/ci/evidence"))
}

/// The crates without their default features: all linted with their tests, the façade tested, as on a server (what the others
/// do on the CPU is the same code with wgpu); then each linted by itself, and no wgpu among what it needs.
fn crates_apart(sections: &mut Sections) -> Result<(), Failure> {
    let packages: String = WITHOUT_WGPU.iter().map(|name| format!(" -p {name}")).collect();
    sections.cargo("test -p open-water --no-default-features")?;
    sections.cargo(&format!("clippy --quiet{packages} --no-default-features --all-targets -- -D warnings"))?;
    for name in WITHOUT_WGPU {
        sections.cargo(&format!("clippy --quiet -p {name} --no-default-features -- -D warnings"))?;
        let (tree, _) =
            sections.cargo_output(&format!("tree -e normal --prefix none -p {name} --no-default-features"))?;
        if tree.lines().any(|line| line.starts_with("wgpu ")) {
            return Err(format!("{name} needs wgpu even without its default features"));
        }
    }
    for (name, feature) in ALONE {
        sections
            .cargo(&format!("clippy --quiet -p {name} --no-default-features --features {feature} -- -D warnings"))?;
    }
    Ok(())
}

/// A few frames of each headless scene; each checks itself and ends with an error when something is wrong.
fn scenes(sections: &mut Sections) -> Result<(), Failure> {
    for (scene, backend) in [
        ("boat", "cpu"),
        ("boat", "gpu"),
        ("harbour", "cpu"),
        ("harbour", "gpu"),
        ("fleet", "cpu"),
        ("fleet", "gpu"),
        ("flotsam", "cpu"),
        ("flotsam", "gpu"),
    ] {
        sections.cargo(&format!(
            "run --release --example {scene} -- --frames 4 --size 320x180 --lead 4 --backend {backend} --out target/ci/{scene}-{backend}"
        ))?;
    }
    for backend in ["cpu", "gpu"] {
        sections.cargo(&format!(
            "run --release --example seas -- --state breeze --then gale --over 1 --frames 36 --size 160x90 --backend {backend} --out target/ci/seas-{backend}"
        ))?;
    }
    for scheme in 1..=3 {
        sections.cargo(&format!(
            "run --release --example kelvin -- --frames 3 --size 320x180 --lead 2 --backend cpu --scheme {scheme} --out target/ci/kelvin-{scheme}"
        ))?;
    }
    sections.cargo("run --release --example server -- --frames 120")?;
    sections.cargo("run --release --example embed -- --frames 4")?;
    sections.cargo("run --release --example plane -- --frames 4 --out target/ci/plane.png")
}

//! Something for wgpu to run on: a graphics card, or lavapipe from the system's packages.

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::Command,
};

use crate::section::{Failure, Sections};

/// What lavapipe needs on Debian and Ubuntu.
const PACKAGES: [&str; 2] = ["libvulkan1", "mesa-vulkan-drivers"];

/// Makes sure that wgpu finds an adapter, installing lavapipe where it may, and says which one the tests use.
///
/// With `software`, or where only a software adapter answers, the Vulkan loader is told to load that one alone.
pub(crate) fn ensure(sections: &mut Sections, no_install: bool, software: bool) -> Result<(), Failure> {
    if !cfg!(target_os = "linux") {
        return list(sections).map(drop);
    }
    let mut installed = false;
    if !loader_present() || drivers().is_empty() || (software && lavapipe().is_none()) {
        install(no_install)?;
        installed = true;
    }
    let kinds = match list(sections) {
        // Drivers are there, but none of them finds its device.
        Err(_) if !installed && lavapipe().is_none() => {
            install(no_install)?;
            list(sections)?
        }
        other => other?,
    };
    if software || kinds.iter().all(|kind| kind == "software") {
        match lavapipe() {
            Some(driver) => {
                println!("the tests use the software adapter: {}", driver.display());
                // Loaders before 1.3.207 know the first name only.
                for name in ["VK_ICD_FILENAMES", "VK_DRIVER_FILES"] {
                    sections.set_env(name, &driver.to_string_lossy());
                }
            }
            None if software => {
                return Err("no description of the lavapipe driver (lvp_icd.*.json)".to_owned());
            }
            None => {}
        }
    }
    Ok(())
}

/// The kinds of the adapters that wgpu finds.
fn list(sections: &Sections) -> Result<Vec<String>, Failure> {
    // Over the whole workspace, so that the built dependencies are those of the tests.
    sections.cargo("build --workspace --example adapters")?;
    let (lines, found) = sections.cargo_output("run --quiet --example adapters")?;
    print!("{lines}");
    let kinds: Vec<String> = lines.lines().filter_map(|line| line.split('\t').next()).map(str::to_owned).collect();
    if found && !kinds.is_empty() { Ok(kinds) } else { Err("wgpu finds no graphics adapter".to_owned()) }
}

/// Installs lavapipe, or says what to type.
fn install(no_install: bool) -> Result<(), Failure> {
    let advice = advice();
    let Some(prefix) = (if no_install { None } else { may_install() }) else {
        return Err(format!(
            "no Vulkan driver found; the GPU tests need one, a software one will do. Type:\n\n    {advice}\n"
        ));
    };
    for words in [vec!["update"], [vec!["install", "-y", "--no-install-recommends"], PACKAGES.to_vec()].concat()] {
        let mut line = prefix.to_vec();
        line.push("apt-get");
        line.extend(words);
        println!("$ {}", line.join(" "));
        let status = Command::new(line[0])
            .args(&line[1..])
            .env("DEBIAN_FRONTEND", "noninteractive")
            .status()
            .map_err(|error| format!("cannot start {}: {error}", line[0]))?;
        if !status.success() {
            return Err(format!("`{}` ended with {status}. Type:\n\n    {advice}\n", line.join(" ")));
        }
    }
    Ok(())
}

/// The words before `apt-get` on a Debian-like system where installing needs no password; `None` elsewhere.
fn may_install() -> Option<&'static [&'static str]> {
    if !debian_like() {
        return None;
    }
    let quiet = |program: &str, words: &[&str]| Command::new(program).args(words).output().ok();
    let id = quiet("id", &["-u"])?;
    if String::from_utf8_lossy(&id.stdout).trim() == "0" {
        return Some(&[]);
    }
    let sudo = quiet("sudo", &["-n", "true"])?;
    sudo.status.success().then_some(&["sudo", "-n"])
}

fn debian_like() -> bool {
    os_release()
        .lines()
        .filter(|line| line.starts_with("ID=") || line.starts_with("ID_LIKE="))
        .any(|line| line.split(['=', ' ', '"']).any(|word| word == "debian" || word == "ubuntu"))
}

fn os_release() -> String {
    fs::read_to_string("/etc/os-release").unwrap_or_default()
}

/// The command that installs a software adapter on this kind of system.
fn advice() -> String {
    let release = os_release();
    let like = |name: &str| release.lines().any(|line| line.starts_with("ID") && line.contains(name));
    if like("fedora") || like("rhel") {
        "sudo dnf install vulkan-loader mesa-vulkan-drivers".to_owned()
    } else if like("arch") {
        "sudo pacman -S vulkan-icd-loader vulkan-swrast".to_owned()
    } else if like("suse") {
        "sudo zypper install libvulkan1 libvulkan_lvp".to_owned()
    } else {
        format!("sudo apt-get update && sudo apt-get install {}", PACKAGES.join(" "))
    }
}

/// Whether the Vulkan loader's library is installed.
fn loader_present() -> bool {
    let listed = ["ldconfig", "/sbin/ldconfig"].iter().any(|program| {
        Command::new(program)
            .arg("-p")
            .output()
            .is_ok_and(|output| String::from_utf8_lossy(&output.stdout).contains("libvulkan.so.1"))
    });
    let searched = env::var_os("LD_LIBRARY_PATH")
        .is_some_and(|paths| env::split_paths(&paths).any(|dir| dir.join("libvulkan.so.1").exists()));
    listed || searched
}

/// Driver descriptions that the loader would read.
fn drivers() -> Vec<PathBuf> {
    for name in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
        if let Some(paths) = env::var_os(name) {
            return env::split_paths(&paths).filter(|path| path.exists()).collect();
        }
    }
    let mut found: Vec<PathBuf> = ["/usr/share", "/usr/local/share", "/etc", "/usr/local/etc"]
        .iter()
        .filter_map(|base| fs::read_dir(Path::new(base).join("vulkan/icd.d")).ok())
        .flat_map(|dir| dir.flatten().map(|entry| entry.path()))
        .filter(|path| path.extension().is_some_and(|ext| ext == "json"))
        .collect();
    found.sort();
    found
}

/// The description of the software driver.
fn lavapipe() -> Option<PathBuf> {
    drivers().into_iter().find(|path| path.to_string_lossy().contains("lvp_icd"))
}

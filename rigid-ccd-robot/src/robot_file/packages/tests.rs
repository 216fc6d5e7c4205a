use super::*;
use std::fs;
use tempfile::TempDir;

/// Creates a folder with the package `arm_description`, whose URDF is in the subfolder `urdf`.
fn create_package() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for file in [
        "arm_description/urdf/arm.urdf",
        "arm_description/meshes/link.stl",
        "other/arm_description/meshes/tip.stl",
    ] {
        let file = folder.path().join(file);
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, "").unwrap();
    }
    folder
}

#[test]
fn files_of_a_package_are_found_around_the_urdf_and_in_given_folders() {
    let folder = create_package();
    let mut packages =
        SearchFolders::for_urdf(&folder.path().join("arm_description/urdf/arm.urdf"));
    let found = packages
        .find_file("package://arm_description/meshes/link.stl")
        .unwrap();
    assert!(found.is_file());
    let beside = packages.find_file("../meshes/link.stl").unwrap();
    assert_eq!(
        fs::canonicalize(beside).unwrap(),
        fs::canonicalize(&found).unwrap()
    );
    let whole = format!("file://{}", found.display());
    assert_eq!(packages.find_file(&whole).unwrap(), found);

    let tip = "package://arm_description/meshes/tip.stl";
    let Err(RobotFileError::MeshNotFound {
        uri,
        searched_paths: tried,
    }) = packages.find_file(tip)
    else {
        panic!("found");
    };
    assert_eq!(uri, tip);
    assert!(
        tried.contains(
            &fs::canonicalize(folder.path())
                .unwrap()
                .join("arm_description/meshes/tip.stl")
        )
    );
    for given in ["other", "other/arm_description"] {
        packages.prepend_folder(folder.path().join(given));
        assert!(packages.find_file(tip).is_ok(), "{given}");
    }
}

#[test]
fn escapes_of_a_uri_are_read() {
    let folder = create_package();
    let meshes = folder.path().join("arm_description/meshes");
    for name in ["left link.stl", "100%.stl", "%20.stl"] {
        fs::write(meshes.join(name), "").unwrap();
    }
    let packages = SearchFolders::for_urdf(&folder.path().join("arm_description/urdf/arm.urdf"));
    for (escaped, name) in [
        ("left%20link.stl", "left link.stl"),
        ("left link.stl", "left link.stl"),
        ("100%.stl", "100%.stl"),
        ("100%25.stl", "100%.stl"),
        // A file with the undecoded name takes precedence.
        ("%20.stl", "%20.stl"),
    ] {
        let found = packages.find_file(&format!("package://arm_description/meshes/{escaped}"));
        let found = fs::canonicalize(found.unwrap()).unwrap();
        assert_eq!(
            found,
            fs::canonicalize(meshes.join(name)).unwrap(),
            "{escaped}"
        );
    }
}

/// Tests that a package is found before a folder of the same name inside it.
#[test]
fn a_package_comes_before_what_is_in_it() {
    let folder = create_package();
    let package = folder.path().join("arm_description");
    let inner = package.join("arm_description/meshes");
    fs::create_dir_all(&inner).unwrap();
    fs::write(inner.join("link.stl"), "").unwrap();
    let packages = SearchFolders::for_urdf(&package.join("urdf/arm.urdf"));
    let found = packages.find_file("package://arm_description/meshes/link.stl");
    let outer = fs::canonicalize(package.join("meshes/link.stl")).unwrap();
    assert_eq!(found.unwrap(), outer);
}

/// Packages that ROS 2 has installed come before those above the URDF: another source of the same package may be there.
#[test]
fn packages_of_ament_prefixes_are_below_share() {
    let folder = create_package();
    let installed = folder.path().join("install/share/arm_description/meshes");
    fs::create_dir_all(&installed).unwrap();
    fs::write(installed.join("link.stl"), "").unwrap();
    let urdf = folder.path().join("arm_description/urdf/arm.urdf");
    let prefixes = [folder.path().join("install")];
    let found = SearchFolders::new(&urdf, Vec::new(), &prefixes)
        .find_file("package://arm_description/meshes/link.stl")
        .unwrap();
    assert_eq!(found, installed.join("link.stl"));
}

use super::{MeshFile, source_paths};
use crate::test_files::Folder;
use crate::{Format, MeshFault, TriangleMesh, Unit};
use ccd_core::glam::DVec3;

/// An OBJ of two objects that share vertices and whose statements alternate, after a face that is in no object.
const TWO_OBJECTS_OBJ: &str = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 2 3 4\no lid #2 # a comment\n\
    f 2 3 5\ng inner\no base#1\nf 3 4 5\ng\no lid #2\nf 4 2 5\no empty\n";

fn read(text: &str) -> MeshFile {
    MeshFile::from_reader(Format::Obj, text.as_bytes()).unwrap()
}

fn names(file: &MeshFile) -> Vec<Option<&str>> {
    file.part_names().collect()
}

#[test]
fn the_parts_of_an_obj_are_its_objects() {
    let file = read(TWO_OBJECTS_OBJ);
    assert_eq!(names(&file), [None, Some("lid"), Some("base#1")]);
    let lid = file.part("lid").unwrap();
    // Its vertices are numbered from 0, in the order of the file.
    assert_eq!(lid.vertices(), [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z]);
    assert_eq!(lid.faces(), [[0, 1, 3], [2, 0, 3]]);
    assert_eq!(lid.face_ids(), [0, 1]);
    assert_eq!(file.part("base#1").unwrap().vertices()[0], DVec3::X);
    // The whole keeps the numbers of the file.
    let whole = read(TWO_OBJECTS_OBJ).into_mesh().unwrap();
    assert_eq!(whole.faces()[3], [3, 1, 4]);
    let parts = read(TWO_OBJECTS_OBJ).into_parts().unwrap();
    let faces: Vec<usize> = parts.iter().map(|part| part.mesh.faces().len()).collect();
    assert_eq!(faces, [1, 2, 1]);
    assert_eq!(parts[1].name.as_deref(), Some("lid"));
    assert_eq!(parts[1].mesh.faces(), lid.faces());
}

#[test]
fn without_objects_the_parts_are_the_groups() {
    let file = read(&TWO_OBJECTS_OBJ.replace("\no ", "\n# o "));
    assert_eq!(names(&file), [None, Some("inner")]);
    assert_eq!(file.part("0").unwrap().faces().len(), 3);
    let plain = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert_eq!(names(&plain), [None]);
    assert_eq!(plain.part("0").unwrap().faces(), [[0, 1, 2]]);
}

#[test]
fn parts_are_found_by_name_first() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no 1\nf 1 2 3\no b\nf 1 2 4\no c\nf 2 3 4\n";
    let file = read(text);
    let first = |name: &str| file.part(name).unwrap().vertices().len();
    assert_eq!(first("1"), 3);
    assert_eq!(file.part("1").unwrap().vertices()[2], DVec3::Y);
    assert_eq!(file.part("2").unwrap().vertices()[2], DVec3::Z);
    let error = file.part("d").unwrap_err().to_string();
    assert_eq!(
        error,
        r#"has no part "d"; its parts are 0 "1", 1 "b", 2 "c""#
    );
    for missing in ["", "3", "-1", "B", "99999999999999999999"] {
        let error = file.part(missing).unwrap_err();
        assert!(
            matches!(error.fault, MeshFault::NoSuchPart { .. }),
            "{error}"
        );
    }
}

#[test]
fn an_unknown_part_of_a_file_without_names_says_so() {
    let plain = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let error = plain.part("lid").unwrap_err().to_string();
    assert_eq!(error, r#"has no part "lid"; it has one, without a name: 0"#);
    let many: String = (0..30).map(|k| format!("o part {k}\nf 1 2 3\n")).collect();
    let many = read(&format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{many}"));
    let error = many.part("lid").unwrap_err().to_string();
    assert!(error.ends_with(r#"19 "part 19" and 10 more"#), "{error}");
}

#[test]
fn a_fault_of_a_part_names_the_part() {
    let file = read("v 0 0 0\nv 1 0 0\nv 0 1 1e14\nv 0 0 1\no a\nf 1 2 4\no b\nf 1 2 3\n");
    assert!(file.part("a").is_ok());
    let error = file.part("b").unwrap_err().to_string();
    assert!(
        error.starts_with(r#"part 1 "b": line 3: vertex 2 has a coordinate beyond"#),
        "{error}"
    );
    let error = file.into_parts().unwrap_err().to_string();
    assert!(error.starts_with(r#"part 1 "b": "#), "{error}");
    // A bad face of another part does not matter.
    let file = read("v 0 0 0\nv 1 0 0\nv 0 1 0\no a\nf 1 2 3\no b\nf 1 2\n");
    let error = file.part("a").unwrap_err().to_string();
    assert!(error.contains("line 7: face 1 has 2 corners"), "{error}");
}

#[test]
fn a_file_without_a_unit_is_taken_as_it_is() {
    let file = read(TWO_OBJECTS_OBJ);
    assert_eq!(file.unit(), None);
    let file = file.converted_to_unit(Unit::Inch);
    assert_eq!(file.unit(), Some(Unit::Inch));
    assert_eq!(file.into_mesh().unwrap().vertices()[0], DVec3::splat(9.0));
}

/// Tests that a file of 100,000 groups is read as 100,000 parts of one face each, in reasonable time.
#[test]
fn many_groups_are_read_at_once() {
    let mut text = String::from("v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    for k in 0..100_000 {
        text.push_str(&format!("g {k}\nf 1 2 3\n"));
    }
    let parts = read(&text).into_parts().unwrap();
    assert_eq!(parts.len(), 100_000);
    assert!(parts.iter().all(|part| part.mesh.faces().len() == 1));
}

#[test]
fn faults_name_the_file() {
    let folder = Folder::new("parts");
    let path = folder.write("two.obj", TWO_OBJECTS_OBJ);
    let file = MeshFile::read(&path).unwrap();
    let error = file.part("top").unwrap_err();
    assert_eq!(error.file.as_deref(), Some(path.as_path()));
    assert_eq!(source_paths(&path).unwrap(), [path.as_path()]);
    let unknown = folder.write("two.gbl", TWO_OBJECTS_OBJ);
    let message = TriangleMesh::read(unknown).unwrap_err().to_string();
    assert!(message.contains("use .gltf, .glb, .dae, .obj"), "{message}");
}

#[cfg(feature = "gltf")]
mod beside {
    use super::*;
    use crate::test_files::Gltf;

    #[test]
    fn buffers_are_read_from_files_beside_the_mesh() {
        let folder = Folder::new("beside");
        let gltf = Gltf::triangle();
        let path = folder.write(
            "part.gltf",
            gltf.text_with_buffer_uri("./deep%20er//da%74a.bin"),
        );
        let error = TriangleMesh::read(&path).unwrap_err();
        assert!(
            matches!(error.fault, MeshFault::UnreadableLinkedFile { .. }),
            "{error}"
        );
        let message = error.to_string();
        assert!(
            message.contains(r#"part.gltf: refers to the file "deep er/data.bin""#),
            "{message}"
        );
        std::fs::create_dir(folder.0.join("deep er")).unwrap();
        let data = folder.write("deep er/data.bin", &gltf.buffer);
        let mesh = TriangleMesh::read(&path).unwrap();
        assert_eq!(mesh.vertices(), [DVec3::ZERO, DVec3::X, DVec3::Y]);
        assert_eq!(source_paths(&path).unwrap(), [path.clone(), data.clone()]);
        // A truncated buffer file is named as that buffer.
        std::fs::write(&data, &gltf.buffer[..35]).unwrap();
        let message = TriangleMesh::read(&path).unwrap_err().to_string();
        assert!(
            message.contains("buffer 0: ends before byte 35 of 36"),
            "{message}"
        );
        // A folder is no file; neither is a pipe, which would never end.
        std::fs::remove_file(&data).unwrap();
        std::fs::create_dir(&data).unwrap();
        let message = TriangleMesh::read(&path).unwrap_err().to_string();
        assert!(message.contains("it is no file"), "{message}");
    }

    #[test]
    fn only_files_in_the_folder_are_read() {
        let folder = Folder::new("outside");
        let gltf = Gltf::triangle();
        folder.write("data.bin", &gltf.buffer);
        let outside = folder.0.join("data.bin").display().to_string();
        std::fs::create_dir(folder.0.join("within")).unwrap();
        let uris = [
            "../data.bin",
            "x/../../data.bin",
            &outside,
            "http://example.org/data.bin",
            "file:data.bin",
            "",
            ".",
        ];
        for uri in uris {
            let path = folder.write("within/part.gltf", gltf.text_with_buffer_uri(uri));
            let error = TriangleMesh::read(&path).unwrap_err();
            let message = error.to_string();
            assert!(
                message.contains("in the folder of the mesh"),
                "{uri}: {message}"
            );
        }
        for uri in ["%", "%4", "%zz"] {
            let path = folder.write("within/part.gltf", gltf.text_with_buffer_uri(uri));
            let message = TriangleMesh::read(&path).unwrap_err().to_string();
            assert!(message.contains("% without two digits"), "{uri}: {message}");
        }
    }

    #[test]
    fn a_reader_has_nothing_beside_it() {
        let text = Gltf::triangle().text_with_buffer_uri("data.bin");
        let error = TriangleMesh::from_reader(Format::Gltf, &text[..]).unwrap_err();
        assert!(
            matches!(error.fault, MeshFault::AtElement { .. }),
            "{error}"
        );
        let message = error.to_string();
        assert!(
            message.contains("bytes have no files beside them"),
            "{message}"
        );
    }
}

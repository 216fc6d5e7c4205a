use super::*;

#[test]
fn each_step_is_read_from_its_opcode() {
    for opcode in 0..=7 {
        assert_eq!(Step::from_opcode(opcode).unwrap().opcode(), opcode);
    }
    assert_eq!(Step::from_opcode(8), None);
}

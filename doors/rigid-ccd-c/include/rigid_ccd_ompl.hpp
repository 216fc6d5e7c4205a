// A motion validator and a state checker for OMPL. Valid motions are certified free of contact, and so is the last valid
// state. The state space must hold joint positions and interpolate linearly, as RealVectorStateSpace does.
#ifndef RIGID_CCD_OMPL_HPP
#define RIGID_CCD_OMPL_HPP

#include "rigid_ccd_cell.hpp"

#ifdef RIGID_CCD_EXPECTED
#error "OMPL needs exceptions: include this header where RIGID_CCD_EXPECTED is not defined"
#endif

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>

#include <utility>
#include <vector>

namespace rigid_ccd {
inline namespace RIGID_CCD_FAILURES {

// Accepts an edge if it is certified free. Do not change the cell while the validator lives.
class OmplMotionValidator : public ompl::base::MotionValidator {
public:
    OmplMotionValidator(const ompl::base::SpaceInformationPtr &space, const Cell &cell, const Settings &settings = {})
        : ompl::base::MotionValidator(space), pool_(cell, settings) {}
    OmplMotionValidator(const ompl::base::SpaceInformationPtr &, Cell &&, const Settings & = {}) = delete;

    bool checkMotion(const ompl::base::State *from, const ompl::base::State *to) const override {
        return count(free_fraction(from, to) >= 1.0);
    }

    // The last valid state is the end of the certified free part of the edge.
    bool checkMotion(const ompl::base::State *from, const ompl::base::State *to,
                     std::pair<ompl::base::State *, double> &last_valid) const override {
        const double fraction = free_fraction(from, to);
        if (fraction >= 1.0) return count(true);
        last_valid.second = fraction;
        if (last_valid.first != nullptr) si_->getStateSpace()->interpolate(from, to, fraction, last_valid.first);
        return count(false);
    }

private:
    bool count(bool is_valid) const {
        (is_valid ? valid_ : invalid_) += 1;
        return is_valid;
    }
    double free_fraction(const ompl::base::State *from, const ompl::base::State *to) const {
        std::vector<double> start, end;
        si_->getStateSpace()->copyToReals(start, from);
        si_->getStateSpace()->copyToReals(end, to);
        return pool_.with_solver([&](CellSolver &solver) { return solver.measure_edge(start, end).alpha(); });
    }
    mutable SolverPool pool_;
};

// Accepts a state if the robot touches nothing and the state is within the bounds of the space.
class OmplStateValidityChecker : public ompl::base::StateValidityChecker {
public:
    OmplStateValidityChecker(const ompl::base::SpaceInformationPtr &space, const Cell &cell, const Settings &settings = {})
        : ompl::base::StateValidityChecker(space), pool_(cell, settings) {}
    OmplStateValidityChecker(const ompl::base::SpaceInformationPtr &, Cell &&, const Settings & = {}) = delete;

    bool isValid(const ompl::base::State *state) const override {
        std::vector<double> positions;
        si_->getStateSpace()->copyToReals(positions, state);
        if (!si_->satisfiesBounds(state)) return false;
        return pool_.with_solver([&](CellSolver &solver) { return solver.first_contact(positions).free(); });
    }

private:
    mutable SolverPool pool_;
};

} // namespace RIGID_CCD_FAILURES
} // namespace rigid_ccd

#endif

#pragma once
#include <placegraph/backend/internal/inertial/imu_preintegration.h>
#include <placegraph/graph/internal/measurements/body_state.h>
#include <placegraph/graph/internal/measurements/sighting.h>

#include <optional>

namespace placegraph {

/// A body's state moves by 15 numbers in the order of BodyState::covariance: position and velocity
/// (world axes), attitude (right tangent), gyro's and accelerometer's bias.
using StateStep = Eigen::Matrix<double, 15, 1>;
using StateMatrix = Eigen::Matrix<double, 15, 15>;
BodyState moved(BodyState state, const StateStep& step);
/// The step that leads from one to the other.
StateStep difference(const BodyState& from, const BodyState& to);

/// An error r of one state or two at some states, and its derivatives by their steps.
struct StateError {
  Eigen::VectorXd r;
  Eigen::MatrixXd J_first;   ///< rows x 15
  Eigen::MatrixXd J_second;  ///< rows x 15; empty if the error is of one state only
  Eigen::MatrixXd information;
};

/// Inertial samples between two states (Forster et al. 2017, eq. 45; biases walk): 15 rows.
///   r = [R_i^T (p_j - p_i - v_i t - g t^2 / 2) - dp;  R_i^T (v_j - v_i - g t) - dv;
///        log(dR^T R_i^T R_j);  bg_j - bg_i;  ba_j - ba_i]
StateError inertial_error(const ImuPreintegration& motion, const BodyState& first,
                          const BodyState& second);

/// The pose of a state as markers tell it: r = [R_m^T (p - p_m); log(R_m^T R)].
StateError pose_error(const PoseMeasurement& observation, const BodyState& state);

/// Flow over the level floor z = `floor_z_m` between two states, c the places of the camera:
///   r = R_cam_body R_i^T (c_j - c_i) / (c_i - floor)_z - flow.
/// Where the gyro's turn was taken out of the flow (J_rotation), r has J_rotation log(R_ij^T
/// R_from_to) beside it, R_ij the camera's turn by the two states: what was wrong with the gyro is
/// known by now. Nothing where the camera is not above the floor.
std::optional<StateError> flow_error(const FlowMeasurement& observation, const SE3& T_body_cam,
                                     double floor_z_m, const BodyState& first,
                                     const BodyState& second);

}  // namespace placegraph

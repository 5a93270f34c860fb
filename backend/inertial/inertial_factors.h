#pragma once
#include <placegraph/backend/inertial/imu_preintegration.h>
#include <placegraph/graph/measurements/body_state.h>

#include <optional>

namespace placegraph {

/// A step of a body's state: 15 numbers in the order of BodyState::covariance.
/// They are position and velocity (world axes), attitude (right tangent), bias of gyroscope and
/// accelerometer.
using StateStep = Eigen::Matrix<double, 15, 1>;
using StateMatrix = Eigen::Matrix<double, 15, 15>;
BodyState moved(BodyState state, const StateStep& step);
/// The step that leads from one to the other.
StateStep difference(const BodyState& from, const BodyState& to);

/// An error r of one or two states, and its derivatives by their steps.
struct StateError {
  Eigen::VectorXd r;
  Eigen::MatrixXd J_first;   ///< rows x 15
  Eigen::MatrixXd J_second;  ///< rows x 15; empty if the error depends on one state
  Eigen::MatrixXd information;
};

/// Error of inertial samples between two states, 15 rows.
/// Forster et al. 2017, eq. 45, with a random walk of the biases:
///   r = [R_i^T (p_j - p_i - v_i t - g t^2 / 2) - dp;  R_i^T (v_j - v_i - g t) - dv;
///        log(dR^T R_i^T R_j);  bg_j - bg_i;  ba_j - ba_i]
StateError inertial_error(const ImuPreintegration& motion, const BodyState& first,
                          const BodyState& second);

/// Error of a state against a pose measured by markers: r = [R_m^T (p - p_m); log(R_m^T R)].
StateError pose_error(const PoseMeasurement& observation, const BodyState& state);

/// Error of the flow over the level floor z = `floor_z_m` between two states.
/// c are the camera centres:
///   r = R_cam_body R_i^T (c_j - c_i) / (c_i - floor)_z - flow.
/// If the rotation by the gyroscope was removed from the flow (J_rotation), J_rotation log(R_ij^T
/// R_from_to) is added to r, with R_ij the camera rotation by the two states; this corrects the
/// error of the gyroscope's rotation. Empty if the camera is not above the floor.
std::optional<StateError> flow_error(const FlowMeasurement& observation, const SE3& T_body_cam,
                                     double floor_z_m, const BodyState& first,
                                     const BodyState& second);

}  // namespace placegraph

# What the libraries link. The order matters: BLAS stands before Ceres, because the packaged Ceres
# brings ATLAS, and the first library on the link line gets CHOLMOD's BLAS calls.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(PNG 1.6 REQUIRED)
find_package(JPEG REQUIRED)
find_package(OpenCV 4.5 REQUIRED COMPONENTS core imgproc imgcodecs calib3d features2d video videoio aruco line_descriptor ml ximgproc)
set(BLA_VENDOR OpenBLAS)
find_package(BLAS REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS CXX)  # faiss names its target without looking for it
find_package(faiss REQUIRED)
# It names the machine's libblas and liblapack by file; OpenBLAS is both.
set_target_properties(faiss PROPERTIES INTERFACE_LINK_LIBRARIES "$<LINK_ONLY:OpenMP::OpenMP_CXX>;BLAS::BLAS")
find_package(CHOLMOD REQUIRED)
find_package(CAMD REQUIRED)
find_package(spectra REQUIRED)
find_package(Ceres 2.1 REQUIRED)
find_package(GeographicLib REQUIRED)
find_package(opengv REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)
find_package(SQLite3 REQUIRED)
